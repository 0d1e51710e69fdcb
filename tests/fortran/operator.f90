! Models of products and solutions of a host alone: the forces are those that the matrix gives. Two pairs;
! both results have eta below 1e-12, and K has a condition number of 3: they agree to 1e-10.
module hosts
    use signorini
    implicit none
    real(c_double), parameter :: k(4, 4) = reshape(real([4, 1, -1, 0, 1, 4, 0, -1, -1, 0, 4, 1, 0, -1, 1, 4], &
        c_double), [4, 4])

    type, extends(contact_operator) :: dense
        integer :: fails = 0, products = 0
    contains
        procedure :: stiffness => dense_stiffness
        procedure :: inverse => dense_inverse
        procedure :: held => dense_held
    end type

    ! A host that forgot to write what it says that it has.
    type, extends(contact_operator) :: forgetful
    contains
        procedure :: stiffness => forgetful_stiffness
    end type

contains

    subroutine dense_stiffness(self, x, y, info)
        class(dense), intent(inout) :: self
        real(c_double), intent(in) :: x(:)
        real(c_double), intent(out) :: y(:)
        integer, intent(inout) :: info
        y = matmul(k, x)
        info = self%fails
        self%products = self%products + 1
    end subroutine

    subroutine dense_inverse(self, x, y, info)
        class(dense), intent(inout) :: self
        real(c_double), intent(in) :: x(:)
        real(c_double), intent(out) :: y(:)
        integer, intent(inout) :: info
        y = x / 4
        info = self%fails
    end subroutine

    ! Sweeps of Gauss and Seidel: each at least halves the error.
    subroutine dense_held(self, held, changed, x, y, info)
        class(dense), intent(inout) :: self
        logical, intent(in) :: held(:), changed
        real(c_double), intent(in) :: x(:)
        real(c_double), intent(out) :: y(:)
        integer, intent(inout) :: info
        integer :: sweep, i
        y = 0
        do sweep = 1, 200
            do i = 1, size(x)
                if (.not. held(i)) y(i) = y(i) + (x(i) - dot_product(k(:, i), y)) / k(i, i)
            end do
        end do
        info = merge(self%fails, 0, changed)
    end subroutine

    subroutine forgetful_stiffness(self, x, y, info)
        class(forgetful), intent(inout) :: self
        real(c_double), intent(in) :: x(:)
        real(c_double), intent(out) :: y(:)
        integer, intent(inout) :: info
        y = merge(2, 1, self%has_inverse) * x
        info = 0
    end subroutine
end module

program operators
    use hosts
    implicit none
    real(c_double), parameter :: f(4) = [2d0, 1.5d0, 3d0, 0.5d0], gap(2) = 0, mu(2) = 0.3d0
    real(c_double) :: d(4), force(4), d2(4), force2(4)
    type(contact_model) :: model
    type(dense) :: host
    type(forgetful) :: bad
    character(len=200) :: message
    integer :: info, way, failed
    failed = 0
    call contact_solve(k, f, gap, d, force, info, friction=mu, tolerance=1d-12, message=message)
    call expect(info == 0, 'by the matrix')
    do way = 1, 2
        host%has_inverse = way == 1
        host%has_held = way == 2
        if (way == 1) call model%new_operator(2, 2, host, info, message=message)
        if (way == 2) call model%new_operator(2, 2, host, info, units=[4d0, 4d0, 4d0, 4d0], message=message)
        call expect(info == 0 .and. model%host_size() == 4, 'a model of operators')
        call model%solve(f, gap, d2, force2, info, friction=mu, tolerance=1d-12, message=message)
        call expect(info == 0, 'its case')
        call expect(maxval(abs(d2 - d)) <= 1d-10 .and. maxval(abs(force2 - force)) <= 1d-10, 'its forces')
        host%fails = 7
        call model%solve(f, gap, d2, force2, info, friction=mu, message=message)
        call expect(info == CONTACT_WRONG_MODEL .and. index(message, '7') > 0, 'a product that fails')
        host%fails = 0
    end do
    call expect(host%products > 0, 'the host is called')
    call model%new_operator(4, 2, host, info, message=message)
    call expect(info == -1 .and. index(message, 'dim is 4') > 0, 'dimension')
    call model%new_operator(2, -2, host, info, message=message)
    call expect(info == -2 .and. index(message, 'pairs is -2') > 0, 'pairs')
    call model%new_operator(2, 2, host, info, units=[1d0], message=message)
    call expect(info == -5 .and. index(message, 'units has 1') > 0, 'units')
    call model%new_operator(2, 2, bad, info, message=message)
    call expect(info == -3 .and. index(message, '-1') > 0, 'an inverse that is not written')
    call model%release()
    if (failed > 0) stop 1
    print '(a)', 'operators: products, solutions with components held, refusals'

contains

    subroutine expect(holds, what)
        logical, intent(in) :: holds
        character(len=*), intent(in) :: what
        if (holds) return
        print '(2a, i0, 2a)', what, ': info ', info, ' ', trim(message)
        failed = failed + 1
    end subroutine
end program
