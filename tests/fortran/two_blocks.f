C     Two blocks whose nodes do not match, in Fortran 77: pairs from
C     their faces, a model, a solution and fields; and what is refused.
C
C     The lower block is 3 by 1, of 3 by 2 elements with 4 nodes, the
C     upper one likewise of 4 by 2. Plane strain, E = 1000, nu = 0.3,
C     no friction; x = 0 is a plane of symmetry, the bottom is held
C     along y, the top is pressed by P = 2. Each strain is constant:
C        eps_y = -P (1 - nu**2) / E,  eps_x = P nu (1 + nu) / E,
C     which elements with 4 nodes have exactly, so that the pressure is
C     P at each node of both sides. To 1D-10: sums of some ten terms,
C     and a condition of some hundred.
C
      PROGRAM TWOBLK
      INCLUDE 'signorini.inc'
      INTEGER NN, ND, MOST, NFIX, NP
      PARAMETER (NN = 27, ND = 54, MOST = 1485, NFIX = 10, NP = 5)
      DOUBLE PRECISION P, E, NU
      PARAMETER (P = 2D0, E = 1D3, NU = 0.3D0)
      DOUBLE PRECISION X(2, NN), A(ND, ND), V(MOST), F(ND), PRESC(NFIX)
      DOUBLE PRECISION GAP(NP), AREA(NP), NORMAL(2, NP), MU(NP)
      DOUBLE PRECISION SLIP0(NP), D(2*NP), R(2*NP), U(ND), ETA, OFF
      DOUBLE PRECISION PRESS(NN), TRACT(2, NN), CLEAR(NN), SLIP(2, NN)
      INTEGER CELL(4, 14), COLPTR(ND + 1), ROWIND(MOST), FIXED(NFIX)
      INTEGER SLAVE(2, 4), MASTER(3, 3), NODE(NP), STATE(NP)
      INTEGER I, NPAIR, NNZ, ITER, INFO, NFAIL, OTHER
      INTEGER*8 HSURF, HANDLE, NONE
      CHARACTER*120 TEXT
      DATA SLIP0 /NP*0D0/, MU /NP*0D0/, PRESC /NFIX*0D0/, F /ND*0D0/
      DATA FIXED /2, 4, 6, 8, 1, 9, 17, 25, 35, 45/
      NFAIL = 0

C     Lower nodes 1 to 12, four in a row; upper ones 13 to 27, five.
      CALL BLOCK(4, 0, 0D0, X, CELL)
      CALL BLOCK(5, 12, 1D0, X, CELL(1, 7))
      CALL STIFF(ND, X, CELL, 14, E, NU, A)
      CALL PACK(ND, A, COLPTR, ROWIND, V, NNZ)

C     The body lies to the left of a line. Zeros fill up a column.
      DO 10 I = 1, 4
         SLAVE(1, I) = 12 + I
         SLAVE(2, I) = 13 + I
   10 CONTINUE
      DO 20 I = 1, 3
         MASTER(1, I) = 13 - I
         MASTER(2, I) = 12 - I
         MASTER(3, I) = 0
   20 CONTINUE
      CALL SGSURF(2, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, SGMORT,
     &            0D0, HSURF, NPAIR, INFO)
      CALL EXPECT('pairs', INFO, 0, NFAIL)
      CALL HOLDS('five pairs', NPAIR .EQ. NP, NFAIL)
      CALL SGSUMM(HSURF, TEXT, 120, INFO)
      CALL HOLDS('summary', TEXT(1:21) .EQ. '5 pairs on 100.00 % o'
     &           .AND. TEXT(120:120) .EQ. ' ', NFAIL)
      CALL SGSGAP(HSURF, NODE, GAP, AREA, NORMAL, INFO)
      CALL EXPECT('gaps', INFO, 0, NFAIL)
      OFF = 0D0
      DO 30 I = 1, NP
         OFF = MAX(OFF, ABS(GAP(I)), ABS(NORMAL(1, I)),
     &             ABS(NORMAL(2, I) + 1D0))
         CALL HOLDS('slave nodes', NODE(I) .EQ. 12 + I, NFAIL)
   30 CONTINUE
      CALL NEAR('gaps and normals', OFF, NFAIL)
      OFF = AREA(1) + AREA(2) + AREA(3) + AREA(4) + AREA(5) - 3D0
      CALL NEAR('area', OFF, NFAIL)

C     The bottom is held along y, the plane of symmetry along x.
      CALL SGSMOD(ND, NNZ, COLPTR, ROWIND, V, 0, NFIX, FIXED, HSURF,
     &            HANDLE, INFO)
      CALL EXPECT('model', INFO, 0, NFAIL)
      DO 40 I = 23, 27
         F(2*I) = -P * 0.75D0
         IF (I .EQ. 23 .OR. I .EQ. 27) F(2*I) = -P * 0.375D0
   40 CONTINUE
      CALL SGCASE(HANDLE, F, PRESC, GAP, SGCOUL, MU, SLIP0, 0,
     &            0D0, 0, D, R, STATE, ETA, ITER, INFO)
      CALL EXPECT('solution', INFO, 0, NFAIL)
      CALL SGRECV(HANDLE, F, PRESC, D, U, INFO)
      CALL EXPECT('displacements', INFO, 0, NFAIL)
      OFF = 0D0
      DO 50 I = 1, NN
         OFF = MAX(OFF,
     &      ABS(U(2*I - 1) - P * NU * (1D0 + NU) / E * X(1, I)),
     &      ABS(U(2*I) + P * (1D0 - NU**2) / E * X(2, I)))
         PRESS(I) = -7D0
   50 CONTINUE
      CALL NEAR('displacements', OFF, NFAIL)
      CALL SGSFLD(HSURF, GAP, SLIP0, D, R, PRESS, TRACT, CLEAR, SLIP,
     &            INFO)
      CALL EXPECT('fields', INFO, 0, NFAIL)
C     Nodes 9 to 17 are those of the two faces; the others keep theirs.
      OFF = 0D0
      DO 60 I = 9, 17
         OFF = MAX(OFF, ABS(PRESS(I) - P), ABS(TRACT(1, I)),
     &             ABS(CLEAR(I)), ABS(SLIP(1, I)), ABS(SLIP(2, I)))
         IF (I .LE. 12) OFF = MAX(OFF, ABS(TRACT(2, I) + P))
         IF (I .GT. 12) OFF = MAX(OFF, ABS(TRACT(2, I) - P))
   60 CONTINUE
      CALL NEAR('pressure on both sides', OFF, NFAIL)
      CALL HOLDS('others', PRESS(8) .EQ. -7D0 .AND. PRESS(18) .EQ. -7D0,
     &           NFAIL)
C     Refusals.
      CALL SGSFLD(HANDLE, GAP, SLIP0, D, R, PRESS, TRACT, CLEAR,
     &            SLIP, INFO)
      CALL EXPECT('a model as pairs', INFO, -1, NFAIL)
      CALL SAYS('there are no such pairs', NFAIL)
      CALL SGRECV(HSURF, F, PRESC, D, U, INFO)
      CALL EXPECT('pairs as a model', INFO, -1, NFAIL)
      CALL SAYS('there is no such model', NFAIL)
      NONE = 0
      CALL SGSMOD(ND, NNZ, COLPTR, ROWIND, V, 0, NFIX, FIXED, NONE,
     &            HANDLE, INFO)
      CALL EXPECT('no pairs', INFO, -9, NFAIL)
      CALL SGSURF(4, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, SGMORT,
     &            0D0, NONE, OTHER, INFO)
      CALL EXPECT('NDIM', INFO, -1, NFAIL)
      CALL SGSURF(2, NN, X, 1, 2, 4, SLAVE, 3, 3, MASTER, SGMORT,
     &            0D0, NONE, OTHER, INFO)
      CALL EXPECT('NDOF', INFO, -4, NFAIL)
      CALL SGSURF(2, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, 2, 0D0,
     &            NONE, OTHER, INFO)
      CALL EXPECT('PAIRNG', INFO, -11, NFAIL)
      CALL SGSURF(2, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, SGNTOS,
     &            -1D0, NONE, OTHER, INFO)
      CALL EXPECT('DIST', INFO, -12, NFAIL)
      SLAVE(2, 4) = 28
      CALL SGSURF(2, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, SGMORT,
     &            0D0, NONE, OTHER, INFO)
      CALL EXPECT('no node 28', INFO, -7, NFAIL)
      CALL SAYS('slave face 4 has node 28', NFAIL)
      SLAVE(2, 4) = 17
      MASTER(3, 2) = 11
      CALL SGSURF(2, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, SGMORT,
     &            0D0, NONE, OTHER, INFO)
      CALL EXPECT('a node twice', INFO, -10, NFAIL)
      CALL SAYS('master face 2 has node 11 twice', NFAIL)
      MASTER(3, 2) = 0
      X(1, 13) = 3D0
      X(1, 17) = 0D0
      CALL SGSURF(2, NN, X, 0, 2, 4, SLAVE, 3, 3, MASTER, SGNTOS,
     &            0D0, NONE, OTHER, INFO)
      CALL EXPECT('faces upon each other', INFO, -7, NFAIL)
      CALL SAYS('lies upon face', NFAIL)
      CALL HOLDS('no handle', NONE .EQ. 0, NFAIL)
      CALL SGSFRE(HSURF, INFO)
      CALL EXPECT('released', INFO, 0, NFAIL)
      CALL HOLDS('its handle', HSURF .EQ. 0, NFAIL)
      CALL SGSFRE(HSURF, INFO)
      CALL EXPECT('released again', INFO, 0, NFAIL)
      IF (NFAIL .NE. 0) STOP 1
      WRITE (*, '(A)') 'two blocks: uniform pressure between meshes'
      END

C     Nodes and elements of a block 3 by 1 with NX nodes along x and
C     three along y, above Y0; FIRST nodes come before.
      SUBROUTINE BLOCK(NX, FIRST, Y0, X, CELL)
      INTEGER NX, FIRST, CELL(4, *), I, J, K, N
      DOUBLE PRECISION Y0, X(2, *)
      K = 0
      DO 20 J = 1, 3
         DO 10 I = 1, NX
            N = FIRST + I + NX * (J - 1)
            X(1, N) = 3D0 * (I - 1) / (NX - 1)
            X(2, N) = Y0 + 0.5D0 * (J - 1)
            IF (I .EQ. NX .OR. J .EQ. 3) GO TO 10
            K = K + 1
            CELL(1, K) = N
            CELL(2, K) = N + 1
            CELL(3, K) = N + NX + 1
            CELL(4, K) = N + NX
   10    CONTINUE
   20 CONTINUE
      END

C     Stiffness of rectangles in plane strain, by 2 by 2 Gauss points.
      SUBROUTINE STIFF(ND, X, CELL, NCELL, E, NU, A)
      INTEGER ND, NCELL, CELL(4, NCELL), C, I, J, K, M
      DOUBLE PRECISION X(2, *), E, NU, A(ND, ND), S, T, G, W(2), H(2, 4)
      DOUBLE PRECISION LAMBDA, MUE, SX(4), SY(4)
      DATA SX /-1D0, 1D0, 1D0, -1D0/, SY /-1D0, -1D0, 1D0, 1D0/
      G = 1D0 / SQRT(3D0)
      LAMBDA = E * NU / ((1D0 + NU) * (1D0 - 2D0 * NU))
      MUE = E / (2D0 * (1D0 + NU))
      DO 20 J = 1, ND
         DO 10 I = 1, ND
            A(I, J) = 0D0
   10    CONTINUE
   20 CONTINUE
      DO 80 C = 1, NCELL
         W(1) = X(1, CELL(2, C)) - X(1, CELL(1, C))
         W(2) = X(2, CELL(4, C)) - X(2, CELL(1, C))
         DO 70 M = 1, 4
            S = G * SX(M)
            T = G * SY(M)
            DO 30 I = 1, 4
               H(1, I) = SX(I) * (1D0 + T * SY(I)) / (2D0 * W(1))
               H(2, I) = SY(I) * (1D0 + S * SX(I)) / (2D0 * W(2))
   30       CONTINUE
            DO 60 I = 1, 4
               DO 50 J = 1, 4
                  DO 40 K = 1, 4
                     CALL ADD(K, CELL(I, C), CELL(J, C), H(1, I),
     &                        H(1, J), LAMBDA, MUE, W, ND, A)
   40             CONTINUE
   50          CONTINUE
   60       CONTINUE
   70    CONTINUE
   80 CONTINUE
      END

C     One of the four entries of two nodes at one Gauss point.
      SUBROUTINE ADD(K, I, J, H, G, LAMBDA, MUE, W, ND, A)
      INTEGER K, I, J, ND, P, Q
      DOUBLE PRECISION H(2), G(2), LAMBDA, MUE, W(2), A(ND, ND), VALUE
      P = 1 + MOD(K, 2)
      Q = 1 + (K - 1) / 2
      VALUE = LAMBDA * H(P) * G(Q) + MUE * H(Q) * G(P)
      IF (P .EQ. Q) VALUE = VALUE + MUE * (H(1) * G(1) + H(2) * G(2))
      A(2*I - 2 + P, 2*J - 2 + Q) = A(2*I - 2 + P, 2*J - 2 + Q)
     &   + 0.25D0 * W(1) * W(2) * VALUE
      END

C     The lower triangle by columns, without its zeros.
      SUBROUTINE PACK(ND, A, COLPTR, ROWIND, V, NNZ)
      INTEGER ND, COLPTR(*), ROWIND(*), NNZ, I, J
      DOUBLE PRECISION A(ND, ND), V(*)
      NNZ = 0
      DO 20 J = 1, ND
         COLPTR(J) = NNZ + 1
         DO 10 I = J, ND
            IF (A(I, J) .EQ. 0D0) GO TO 10
            NNZ = NNZ + 1
            ROWIND(NNZ) = I
            V(NNZ) = A(I, J)
   10    CONTINUE
   20 CONTINUE
      COLPTR(ND + 1) = NNZ + 1
      END

      SUBROUTINE NEAR(WHAT, OFF, NFAIL)
      CHARACTER*(*) WHAT
      DOUBLE PRECISION OFF
      INTEGER NFAIL
      WRITE (*, '(A, T26, A, 1P, E9.1)') WHAT, 'off by', ABS(OFF)
      CALL HOLDS(WHAT, ABS(OFF) .LE. 1D-10, NFAIL)
      END

      SUBROUTINE HOLDS(WHAT, TRUE, NFAIL)
      CHARACTER*(*) WHAT
      LOGICAL TRUE
      INTEGER NFAIL
      IF (TRUE) RETURN
      WRITE (*, '(2A)') '   FAIL: ', WHAT
      NFAIL = NFAIL + 1
      END

C     The last sentence has these words.
      SUBROUTINE SAYS(WORDS, NFAIL)
      CHARACTER*(*) WORDS
      INTEGER NFAIL
      CHARACTER*256 TEXT
      CALL SGMESG(TEXT, 256)
      CALL HOLDS(WORDS, INDEX(TEXT, WORDS) .NE. 0, NFAIL)
      END

      SUBROUTINE EXPECT(WHAT, INFO, WANTED, NFAIL)
      CHARACTER*(*) WHAT
      INTEGER INFO, WANTED, NFAIL
      CHARACTER*96 TEXT
      CALL SGMESG(TEXT, 96)
      WRITE (*, '(A, T26, I6, 2X, A)') WHAT, INFO, TEXT
      CALL HOLDS(WHAT, INFO .EQ. WANTED .AND. ((INFO .EQ. 0) .EQV.
     &           (TEXT .EQ. ' ')), NFAIL)
      END
