C     Wrong arguments: INFO tells which, SGMESG what is wrong with it,
C     counting from 1. Before that the laws.
C     Compiled with trapping: a NaN must be refused, not met.
C
      PROGRAM BADIN
      INCLUDE 'signorini.inc'
      DOUBLE PRECISION K(4, 4), F(4), GAP(2), MU(2), SLIP0(2)
      DOUBLE PRECISION D(4), R(4)
      DOUBLE PRECISION ETA, NAN, V(4), RN(2), U(4), WT(1)
      INTEGER STATE(2), ITER, INFO, I, J, NFAIL
      INTEGER COLPTR(5), ROWIND(4), FIXED(1), SLAVE(2), NOT(2)
      INTEGER*4 BITS(2)
      INTEGER*8 HANDLE
      EQUIVALENCE (NAN, BITS)
      DATA MU /2*0.3D0/, GAP /2*0D0/, SLIP0 /2*0D0/
      DATA F /2D0, 1.5D0, 3D0, 0.5D0/
      DATA COLPTR /1, 2, 3, 4, 5/, ROWIND /1, 2, 3, 4/, V /4*1D0/
      DATA FIXED /4/, SLAVE /1, 2/, RN /0D0, -1D0/, NOT /2*0/
      BITS(1) = 2146959360
      BITS(2) = 2146959360
      NFAIL = 0
      WT(1) = 1D0
      DO 20 J = 1, 4
         DO 10 I = 1, 4
            K(I, J) = 0D0
   10    CONTINUE
         K(J, J) = 4D0
   20 CONTINUE

      CALL LAWS(NFAIL)
      CALL TRIPLE(NFAIL)
      CALL SGSOLV(4, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('dimension', INFO, -1, NFAIL)
      CALL SGSOLV(2, -2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('negative NPAIR', INFO, -2, NFAIL)
      CALL SGSOLV(2, 2, K, 3, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('short LDK', INFO, -4, NFAIL)
      CALL SAYS('NDIM * NPAIR', NFAIL)
      CALL SGSOLV(2, 2, K, 4, F, GAP, 8, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('no such LAW', INFO, -7, NFAIL)
      CALL SAYS('LAW is 8', NFAIL)
      CALL SAYS('SGNOFR (0) to SGTIED (7)', NFAIL)
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 9,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('no such METHOD', INFO, -10, NFAIL)
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, SGPIVO,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('METHOD without friction', INFO, -10, NFAIL)
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            NAN, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('NaN as TOL', INFO, -11, NFAIL)
      CALL SAYS('DOUBLE PRECISION', NFAIL)
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, -1, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('negative MAXIT', INFO, -12, NFAIL)
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, D, STATE, ETA, ITER, INFO)
      CALL EXPECT('D is R', INFO, -14, NFAIL)
      K(3, 2) = NAN
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('NaN in K', INFO, -3, NFAIL)
      CALL SAYS('K(3,2)', NFAIL)
      CALL SGLCPS(4, K, 4, F, 0, 0D0, 0, D, R, ETA, ITER, INFO)
      CALL EXPECT('NaN in M', INFO, -2, NFAIL)
      CALL SAYS('M(3,2)', NFAIL)
      K(3, 2) = 0D0
      CALL SGLCPS(4, K, 4, F, SGPATH, 0D0, 0, D, R, ETA, ITER, INFO)
      CALL EXPECT('METHOD of no LCP', INFO, -5, NFAIL)
      CALL SAYS('method: an LCP is solved by', NFAIL)
      MU(2) = -1D0
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('negative FRIC', INFO, -8, NFAIL)
      CALL SAYS('(2)', NFAIL)
      MU(2) = 0.3D0
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('nothing wrong', INFO, 0, NFAIL)
C     One sweep is not enough for two pairs that are coupled.
      DO 25 I = 1, 2
         K(I, I + 2) = -1D0
         K(I + 2, I) = -1D0
         K(2*I - 1, 2*I) = 1D0
         K(2*I, 2*I - 1) = 1D0
   25 CONTINUE
      CALL SGSOLV(2, 2, K, 4, F, GAP, SGCOUL, MU, SLIP0, SGNEST,
     &            0D0, 1, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('one sweep', INFO, SGITER, NFAIL)

C     Models: an index base of 0, rows and slaves out of range.
      DO 30 I = 1, 5
         COLPTR(I) = COLPTR(I) - 1
   30 CONTINUE
      CALL SGSPAR(4, 4, COLPTR, ROWIND, V, 0, 1, FIXED, 2, 1,
     &            SLAVE, 0, NOT, NOT, WT, RN, 0, WT, HANDLE, INFO)
      CALL EXPECT('COLPTR from 0', INFO, -3, NFAIL)
      CALL SAYS('COLPTR(1) is 0', NFAIL)
      DO 40 I = 1, 5
         COLPTR(I) = COLPTR(I) + 1
   40 CONTINUE
      SLAVE(1) = 0
      CALL SGSPAR(4, 4, COLPTR, ROWIND, V, 0, 1, FIXED, 2, 1,
     &            SLAVE, 0, NOT, NOT, WT, RN, 0, WT, HANDLE, INFO)
      CALL EXPECT('SLAVE from 0', INFO, -11, NFAIL)
      SLAVE(1) = 1
      FIXED(1) = 5
      CALL SGSPAR(4, 4, COLPTR, ROWIND, V, 0, 1, FIXED, 2, 1,
     &            SLAVE, 0, NOT, NOT, WT, RN, 0, WT, HANDLE, INFO)
      CALL EXPECT('FIXED out of range', INFO, -8, NFAIL)
      CALL SAYS('degree of freedom 5', NFAIL)
      FIXED(1) = 4
      CALL SGSPAR(4, 4, COLPTR, ROWIND, V, 0, 1, FIXED, 2, 1,
     &            SLAVE, 0, NOT, NOT, WT, RN, 0, WT, HANDLE, INFO)
      CALL EXPECT('nothing wrong', INFO, 0, NFAIL)
      F(2) = NAN
      CALL SGCASE(HANDLE, F, SLIP0, GAP, SGCOUL, MU, SLIP0,
     &            0, 0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('NaN in F', INFO, -2, NFAIL)
      CALL SAYS('f(2)', NFAIL)
      F(2) = -1.5D0
      CALL SGCASE(HANDLE, F, SLIP0, GAP, SGCOUL, MU, SLIP0,
     &            0, 0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('nothing wrong', INFO, 0, NFAIL)
      CALL SGRECV(HANDLE, F, SLIP0, D, U, INFO)
      CALL EXPECT('nothing wrong', INFO, 0, NFAIL)
      CALL SGFREE(HANDLE, INFO)
      CALL EXPECT('nothing wrong', INFO, 0, NFAIL)
      HANDLE = 12345
      CALL SGRECV(HANDLE, F, SLIP0, D, U, INFO)
      CALL EXPECT('no such HANDLE', INFO, -1, NFAIL)
      CALL SGFREE(HANDLE, INFO)
      CALL EXPECT('no such HANDLE', INFO, -1, NFAIL)
      IF (NFAIL .NE. 0) STOP 1
      WRITE (*, '(A)') 'bad input: refused, with a sentence each'
      END

C     One pair under f = (2, 1) on K = (4 1; 1 4), which slips. Without
C     friction 4 d_t = 1, with mu = 0.3 and the pressure 2 - d_t
C     4 d_t = 1 - 0.3 (2 - d_t), with the threshold 0.3 4 d_t = 0.7.
      SUBROUTINE LAWS(NFAIL)
      INCLUDE 'signorini.inc'
      INTEGER NFAIL, LAW, ITER, INFO, STATE(1)
      DOUBLE PRECISION K(2, 2), F(2), GAP(1), FRIC(1), SLIP0(1)
      DOUBLE PRECISION D(2), R(2), ETA, WANTED(0:2)
      DATA K /4D0, 1D0, 1D0, 4D0/, F /2D0, 1D0/, FRIC /0.3D0/
      DATA GAP /0D0/, SLIP0 /0D0/
      WANTED(SGNOFR) = 0.25D0
      WANTED(SGCOUL) = 0.4D0 / 3.7D0
      WANTED(SGTRSC) = 0.175D0
      DO 10 LAW = SGNOFR, SGTRSC
         CALL SGSOLV(2, 1, K, 2, F, GAP, LAW, FRIC, SLIP0, 0, 0D0, 0,
     &               D, R, STATE, ETA, ITER, INFO)
         CALL EXPECT('law', INFO, 0, NFAIL)
         IF (ABS(D(2) - WANTED(LAW)) .GT. 1D-9) THEN
            WRITE (*, '(A, I2, A, F12.9)') '   FAIL: law', LAW, D(2)
            NFAIL = NFAIL + 1
         END IF
   10 CONTINUE
      END

C     That pair with mu = 0.3, the cohesion 0.2 and the tension 0.1:
C     4 d_t = 1 - 0.3 (2 - d_t) - 0.2. In space, on unit springs, a pair
C     pressed by 1 with the coefficient 0.6 along t1: d_t1 = f_t1 - 0.6.
      SUBROUTINE TRIPLE(NFAIL)
      INCLUDE 'signorini.inc'
      INTEGER NFAIL, LAW, ITER, INFO, STATE(1)
      DOUBLE PRECISION K(2, 2), F(2), GAP(1), FRIC(3, 1), SLIP0(2)
      DOUBLE PRECISION K3(3, 3), F3(3), AXES(3, 1), D(3), R(3), ETA
      DATA K /4D0, 1D0, 1D0, 4D0/, F /2D0, 1D0/
      DATA FRIC /0.3D0, 0.2D0, 0.1D0/, AXES /0.6D0, 0.2D0, 0D0/
      DATA K3 /1D0, 3*0D0, 1D0, 3*0D0, 1D0/, F3 /1D0, 1.5D0, 0D0/
      DATA GAP /0D0/, SLIP0 /2*0D0/
      CALL SGSOLV(2, 1, K, 2, F, GAP, SGCOHE, FRIC, SLIP0, 0, 0D0, 0,
     &            D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('cohesion', INFO, 0, NFAIL)
      IF (ABS(D(2) - 0.2D0 / 3.7D0) .GT. 1D-9) THEN
         WRITE (*, '(A, F12.9)') '   FAIL: cohesion', D(2)
         NFAIL = NFAIL + 1
      END IF
      FRIC(2, 1) = 0.02D0
      CALL SGSOLV(2, 1, K, 2, F, GAP, SGCOHE, FRIC, SLIP0, 0, 0D0, 0,
     &            D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('b below mu a', INFO, -8, NFAIL)
      CALL SAYS('friction(2) (b of pair 1)', NFAIL)
      CALL SGSOLV(2, 1, K, 2, F, GAP, SGORTH, AXES, SLIP0, 0, 0D0, 0,
     &            D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('orthotropic in the plane', INFO, -7, NFAIL)
      DO 20 LAW = SGORTH, SGORTC
         AXES(1, 1) = 0.6D0
         CALL SGSOLV(3, 1, K3, 3, F3, GAP, LAW, AXES, SLIP0, 0, 0D0,
     &               0, D, R, STATE, ETA, ITER, INFO)
         CALL EXPECT('orthotropic', INFO, 0, NFAIL)
         IF (ABS(D(2) - 0.9D0) + ABS(D(3)) .GT. 1D-9) THEN
            WRITE (*, '(A, 2F12.9)') '   FAIL: orthotropic', D(2), D(3)
            NFAIL = NFAIL + 1
         END IF
         AXES(1, 1) = 0D0
         CALL SGSOLV(3, 1, K3, 3, F3, GAP, LAW, AXES, SLIP0, 0, 0D0,
     &               0, D, R, STATE, ETA, ITER, INFO)
         CALL EXPECT('mu1 is 0', INFO, -8, NFAIL)
         CALL SAYS('friction(1) (mu1 of pair 1) is 0', NFAIL)
   20 CONTINUE
      CALL SGSOLV(3, 1, K3, 3, F3, GAP, 8, AXES, SLIP0, 0, 0D0, 0,
     &            D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('no law 8', INFO, -7, NFAIL)
      END

C     The last sentence has these words.
      SUBROUTINE SAYS(WORDS, NFAIL)
      CHARACTER*(*) WORDS
      INTEGER NFAIL
      CHARACTER*256 TEXT
      CALL SGMESG(TEXT, 256)
      IF (INDEX(TEXT, WORDS) .EQ. 0) THEN
         WRITE (*, '(2A)') '   FAIL: not a word of ', WORDS
         NFAIL = NFAIL + 1
      END IF
      END

      SUBROUTINE EXPECT(WHAT, INFO, WANTED, NFAIL)
      CHARACTER*(*) WHAT
      INTEGER INFO, WANTED, NFAIL
      CHARACTER*96 TEXT
      CALL SGMESG(TEXT, 96)
      WRITE (*, '(A, T26, I4, 2X, A)') WHAT, INFO, TEXT
      IF (INFO .NE. WANTED .OR. (INFO .EQ. 0) .NEQV. (TEXT .EQ. ' '))
     &   THEN
         WRITE (*, '(A, I6)') '   FAIL: wanted INFO =', WANTED
         NFAIL = NFAIL + 1
      END IF
      END
