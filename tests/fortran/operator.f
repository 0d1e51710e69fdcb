C     A model of products and solutions alone gives the forces that the
C     matrix itself gives; a subroutine that fails ends the call. Two
C     pairs. Both results have ETA below 1D-12, and K has a condition
C     number of 3: they agree to 1D-10.
C
      PROGRAM OPERAT
      INCLUDE 'signorini.inc'
      EXTERNAL STIFF, WINV, HELD
      DOUBLE PRECISION K(4, 4), F(4), GAP(2), MU(2), SLIP0(2), PRESC(1)
      DOUBLE PRECISION D(4), R(4), D2(4), R2(4), ETA
      INTEGER STATE(2), ITER, INFO, I, NFAIL, FAILS
      INTEGER*8 HANDLE
      CHARACTER*200 TEXT
      COMMON /HOST/ K, FAILS
      DATA MU /2*0.3D0/, GAP /2*0D0/, SLIP0 /2*0D0/
      DATA F /2D0, 1.5D0, 3D0, 0.5D0/
      DATA NFAIL /0/
      CALL FILL(K)
      FAILS = 0
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0, 1D-12, 0,
     &            D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('by the matrix', INFO, 0, NFAIL)
      DO 20 I = 1, 2
         IF (I .EQ. 1) CALL SGOPER(2, 2, STIFF, WINV, HANDLE, INFO)
         IF (I .EQ. 2) CALL SGOPEH(2, 2, STIFF, HELD, HANDLE, INFO)
         CALL EXPECT('operator', INFO, 0, NFAIL)
         CALL SGCASE(HANDLE, F, PRESC, GAP, SGCOUL, MU, SLIP0, 0,
     &               1D-12, 0, D2, R2, STATE, ETA, ITER, INFO)
         CALL EXPECT('its case', INFO, 0, NFAIL)
         CALL NEAR(D, D2, NFAIL)
         CALL NEAR(R, R2, NFAIL)
         FAILS = 7
         CALL SGCASE(HANDLE, F, PRESC, GAP, SGCOUL, MU, SLIP0, 0,
     &               1D-12, 0, D2, R2, STATE, ETA, ITER, INFO)
         CALL EXPECT('a product fails', INFO, -1, NFAIL)
         CALL SGMESG(TEXT, 200)
         IF (INDEX(TEXT, '7') .EQ. 0) THEN
            WRITE (*, *) 'the sentence lacks IFAIL: ', TEXT
            NFAIL = NFAIL + 1
         END IF
         FAILS = 0
         CALL SGFREE(HANDLE, INFO)
   20 CONTINUE
      CALL SGOPER(4, 2, STIFF, WINV, HANDLE, INFO)
      CALL EXPECT('dimension', INFO, -1, NFAIL)
      CALL SGOPER(2, -2, STIFF, WINV, HANDLE, INFO)
      CALL EXPECT('negative NPAIR', INFO, -2, NFAIL)
      K(1, 2) = 2D0
      CALL SGOPER(2, 2, STIFF, WINV, HANDLE, INFO)
      CALL EXPECT('not symmetric', INFO, -3, NFAIL)
      IF (HANDLE .NE. 0) NFAIL = NFAIL + 1
      IF (NFAIL .GT. 0) STOP 1
      WRITE (*, *) 'operators: products, solutions with MASK, refusals'
      END

      SUBROUTINE FILL(K)
      DOUBLE PRECISION K(4, 4)
      INTEGER I, J
      DO 20 J = 1, 4
         DO 10 I = 1, 4
            K(I, J) = 0D0
   10    CONTINUE
         K(J, J) = 4D0
   20 CONTINUE
      K(1, 2) = 1D0
      K(2, 1) = 1D0
      K(3, 4) = 1D0
      K(4, 3) = 1D0
      K(1, 3) = -1D0
      K(3, 1) = -1D0
      K(2, 4) = -1D0
      K(4, 2) = -1D0
      END

      SUBROUTINE STIFF(N, X, Y, IFAIL)
      INTEGER N, IFAIL, I, J, FAILS
      DOUBLE PRECISION X(N), Y(N), K(4, 4)
      COMMON /HOST/ K, FAILS
      DO 20 I = 1, N
         Y(I) = 0D0
         DO 10 J = 1, N
            Y(I) = Y(I) + K(I, J) * X(J)
   10    CONTINUE
   20 CONTINUE
      IFAIL = FAILS
      END

C     The inverse of the diagonal, which is near enough. IFAIL is left
C     as it is.
      SUBROUTINE WINV(N, X, Y, IFAIL)
      INTEGER N, IFAIL, I
      DOUBLE PRECISION X(N), Y(N)
      DO 10 I = 1, N
         Y(I) = X(I) / 4D0
   10 CONTINUE
      IF (IFAIL .NE. 0) STOP 1
      END

C     Sweeps of Gauss and Seidel, 200: each at least halves the error.
      SUBROUTINE HELD(N, MASK, NEW, X, Y, IFAIL)
      INTEGER N, MASK(N), NEW, IFAIL, I, J, L, FAILS
      DOUBLE PRECISION X(N), Y(N), K(4, 4), S
      COMMON /HOST/ K, FAILS
      IF (NEW .NE. 0 .AND. NEW .NE. 1) STOP 1
      DO 5 I = 1, N
         Y(I) = 0D0
    5 CONTINUE
      DO 30 L = 1, 200
         DO 20 I = 1, N
            IF (MASK(I) .EQ. 0) THEN
               S = X(I)
               DO 10 J = 1, N
                  IF (J .NE. I) S = S - K(I, J) * Y(J)
   10          CONTINUE
               Y(I) = S / K(I, I)
            END IF
   20    CONTINUE
   30 CONTINUE
      IFAIL = FAILS
      END

      SUBROUTINE NEAR(A, B, NFAIL)
      DOUBLE PRECISION A(4), B(4)
      INTEGER NFAIL, I
      DO 10 I = 1, 4
         IF (.NOT. ABS(A(I) - B(I)) .LE. 1D-10) THEN
            WRITE (*, *) 'component', I, A(I), B(I)
            NFAIL = NFAIL + 1
         END IF
   10 CONTINUE
      END

      SUBROUTINE EXPECT(WHAT, INFO, WANTED, NFAIL)
      CHARACTER*(*) WHAT
      INTEGER INFO, WANTED, NFAIL
      CHARACTER*200 TEXT
      IF (INFO .NE. WANTED) THEN
         CALL SGMESG(TEXT, 200)
         WRITE (*, *) WHAT, ': INFO is', INFO, ', not', WANTED, TEXT
         NFAIL = NFAIL + 1
      END IF
      END
