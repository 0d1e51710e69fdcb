! Integers of 4 bytes handed to the entries that take 8: two of them make one that is absurd, which
! is refused with a sentence. The arrays have room for what the entries write.
program widths
    implicit none
    integer(4), target :: i(8), state(8)
    integer(4) :: info(2)
    double precision :: k(4, 4), f(4), v(4), d(4), r(4), eta
    character(96) :: text
    integer :: j, failed
    failed = 0
    k = 0
    v = 0
    do j = 1, 4
        k(j, j) = 4
    end do
    f = 1
    do j = 1, 4
        ! One of dimension, pairs and leading dimension at a time has a neighbour.
        i = [2, 0, 2, 0, 4, 0, 0, 0]
        if (j < 4) i(2*j) = 7
        info = 0
        call sgsolv_64(i(1), i(3), k, i(5), f, v, i(7), v, v, i(7), 0d0, i(7), d, r, state, eta, i(7), info)
        text = ' '
        call sgmesg(text, 96)
        print '(a, i0, 2a)', 'INFO = ', info(1), '  ', trim(text)
        if (j < 4 .and. (info(1) >= 0 .or. text == ' ')) failed = failed + 1
        if (j == 4 .and. info(1) /= 0) failed = failed + 1
    end do
    if (failed /= 0) stop 1
end program
