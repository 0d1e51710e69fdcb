C     The bar on the plane by a program with a skyline solver of its own.
C
C     Your program has: a mesh, equation numbers, assembly under a
C     skyline, the factors L D L' of it. What it adds for contact: the
C     components of the contact side are no equations; their couplings
C     are columns that its own solver condenses (CONDNS), and SGSOLV
C     finds the contact forces. It prints d_n, d_t, F_n, F_t of each node
C     of the contact side, in mm and daN.
C
C     One source serves both widths of integers: for 8 bytes it is
C     compiled with -fdefault-integer-8 and -DSGSOLV=SGSOLV_64, likewise
C     for the other names.
C
      PROGRAM SKYLIN
      INCLUDE 'signorini.inc'
      INTEGER NX, NY, NNODE, NPAIR, NC, MAXEQ, MAXSKY
      PARAMETER (NX = 32, NY = 5, NNODE = (NX + 1) * (NY + 1))
      PARAMETER (NPAIR = NX + 1, NC = 2 * NPAIR)
      PARAMETER (MAXEQ = 2 * NNODE, MAXSKY = MAXEQ * 80)
      INTEGER ID(2, NNODE), IDIAG(MAXEQ), STATE(NPAIR)
      INTEGER NEQ, I, INFO, ITER
      DOUBLE PRECISION X(2, NNODE), SKY(MAXSKY), P(MAXEQ)
      DOUBLE PRECISION KIC(MAXEQ, NC), KC(NC, NC), FC(NC), WORK(MAXEQ)
      DOUBLE PRECISION GAP(NPAIR), MU(NPAIR), SLIP0(NPAIR)
      DOUBLE PRECISION D(NC), R(NC), ETA
      CHARACTER*128 TEXT

      CALL MESH(NX, NY, X)
      CALL EQUATS(NX, NY, ID, NEQ)
      CALL PROFIL(NX, NY, ID, NEQ, MAXSKY, IDIAG)
      CALL ASSEMB(NX, NY, X, ID, NEQ, IDIAG, SKY, P, MAXEQ, NC,
     &            KIC, KC, FC)
      CALL LDLT(NEQ, IDIAG, SKY)
      CALL CONDNS(NEQ, IDIAG, SKY, P, MAXEQ, NC, KIC, KC, FC, WORK)

      DO 10 I = 1, NPAIR
         GAP(I) = 0D0
         MU(I) = 1D0
         SLIP0(I) = 0D0
   10 CONTINUE
C     Method 0 chooses; tolerance 1E-13; at most as many iterations as
C     the library thinks fit.
      CALL SGSOLV(2, NPAIR, KC, NC, FC, GAP, SGCOUL, MU, SLIP0,
     &            0, 1D-13, 0, D, R, STATE, ETA, ITER, INFO)
      IF (INFO .NE. 0) THEN
         CALL SGMESG(TEXT, 128)
         WRITE (*, '(A, I6, 2A)') 'INFO =', INFO, ': ', TEXT
         STOP 1
      END IF
      WRITE (*, '(A, 1P, E8.1)') 'solved and certified, eta =', ETA
      DO 20 I = 1, NPAIR
         WRITE (*, '(A, I3, I2, 1P, 4E20.12)') 'node', I, STATE(I),
     &      D(2*I-1), D(2*I), R(2*I-1), R(2*I)
   20 CONTINUE
      END

C     Nodes row by row from the contact side, y = 0; rows grow by 1.7.
      SUBROUTINE MESH(NX, NY, X)
      INTEGER NX, NY, I, J
      DOUBLE PRECISION X(2, NX + 1, NY + 1), SUM, Y
      SUM = (1.7D0**NY - 1D0) / 0.7D0
      Y = 0D0
      DO 20 J = 1, NY + 1
         DO 10 I = 1, NX + 1
            X(1, I, J) = 40D0 * (I - 1) / NX
            X(2, I, J) = Y
   10    CONTINUE
         Y = Y + 40D0 * 1.7D0**(J - 1) / SUM
   20 CONTINUE
      END

C     Equation numbers of (u_x, u_y): 0 held, -C the contact component C
C     in the order (n, t) node by node, otherwise an equation.
      SUBROUTINE EQUATS(NX, NY, ID, NEQ)
      INTEGER NX, NY, NEQ, I, J, K
      INTEGER ID(2, NX + 1, NY + 1)
      NEQ = 0
      DO 40 I = 1, NX + 1
         DO 30 J = 1, NY + 1
            DO 20 K = 1, 2
               IF (K .EQ. 1 .AND. I .EQ. NX + 1) THEN
                  ID(K, I, J) = 0
               ELSE IF (J .EQ. 1) THEN
                  IF (K .EQ. 1) ID(K, I, J) = -2 * I
                  IF (K .EQ. 2) ID(K, I, J) = -(2 * I - 1)
               ELSE
                  NEQ = NEQ + 1
                  ID(K, I, J) = NEQ
               END IF
   20       CONTINUE
   30    CONTINUE
   40 CONTINUE
      END

C     The eight equation numbers of an element, anticlockwise.
      SUBROUTINE NUMBER(NX, I, J, ID, IEQ)
      INTEGER NX, I, J, ID(2, *), IEQ(8), NODE(4), A
      NODE(1) = (J - 1) * (NX + 1) + I
      NODE(2) = NODE(1) + 1
      NODE(3) = NODE(2) + NX + 1
      NODE(4) = NODE(1) + NX + 1
      DO 10 A = 1, 4
         IEQ(2*A-1) = ID(1, NODE(A))
         IEQ(2*A) = ID(2, NODE(A))
   10 CONTINUE
      END

C     Where each diagonal entry stands in the skyline: column J holds its
C     entries from the first that is not zero down to the diagonal.
      SUBROUTINE PROFIL(NX, NY, ID, NEQ, MAXSKY, IDIAG)
      INTEGER NX, NY, ID(*), NEQ, MAXSKY, IDIAG(NEQ)
      INTEGER I, J, A, LEAST, IEQ(8)
      DO 10 I = 1, NEQ
         IDIAG(I) = I
   10 CONTINUE
      DO 50 J = 1, NY
         DO 40 I = 1, NX
            CALL NUMBER(NX, I, J, ID, IEQ)
            LEAST = NEQ
            DO 20 A = 1, 8
               IF (IEQ(A) .GT. 0) LEAST = MIN(LEAST, IEQ(A))
   20       CONTINUE
            DO 30 A = 1, 8
               IF (IEQ(A) .GT. 0)
     &            IDIAG(IEQ(A)) = MIN(IDIAG(IEQ(A)), LEAST)
   30       CONTINUE
   40    CONTINUE
   50 CONTINUE
      IDIAG(1) = 1
      DO 60 I = 2, NEQ
         IDIAG(I) = IDIAG(I-1) + I - IDIAG(I) + 1
   60 CONTINUE
      IF (IDIAG(NEQ) .GT. MAXSKY) STOP 3
      END

C     Element stiffnesses and loads into the skyline, the couplings with
C     the contact components, and the contact components themselves.
C     d_n = -u_y: each y component of the contact side changes its sign.
      SUBROUTINE ASSEMB(NX, NY, X, ID, NEQ, IDIAG, SKY, P, MAXEQ, NC,
     &                  KIC, KC, FC)
      INTEGER NX, NY, ID(2, *), NEQ, IDIAG(NEQ), MAXEQ, NC
      DOUBLE PRECISION X(2, *), SKY(*), P(MAXEQ)
      DOUBLE PRECISION KIC(MAXEQ, NC), KC(NC, NC), FC(NC)
      INTEGER I, J, A, B, M, N, NODE, IEQ(8)
      DOUBLE PRECISION S(8, 8), H, W, E(8), SA, SB
      DO 10 I = 1, IDIAG(NEQ)
         SKY(I) = 0D0
   10 CONTINUE
      DO 30 J = 1, NC
         FC(J) = 0D0
         DO 15 I = 1, NC
            KC(I, J) = 0D0
   15    CONTINUE
         DO 20 I = 1, NEQ
            P(I) = 0D0
            KIC(I, J) = 0D0
   20    CONTINUE
   30 CONTINUE
      DO 80 J = 1, NY
         DO 70 I = 1, NX
            NODE = (J - 1) * (NX + 1) + I
            W = X(1, NODE + 1) - X(1, NODE)
            H = X(2, NODE + NX + 1) - X(2, NODE)
            CALL ELEMNT(W, H, S)
            DO 40 A = 1, 8
               E(A) = 0D0
   40       CONTINUE
C           10 on the side x = 0, 5 on the top, both inward.
            IF (I .EQ. 1) E(1) = 10D0 * H / 2D0
            IF (I .EQ. 1) E(7) = 10D0 * H / 2D0
            IF (J .EQ. NY) E(6) = -5D0 * W / 2D0
            IF (J .EQ. NY) E(8) = -5D0 * W / 2D0
            CALL NUMBER(NX, I, J, ID, IEQ)
            DO 60 A = 1, 8
               M = IEQ(A)
               SA = 1D0
               IF (M .LT. 0 .AND. MOD(A, 2) .EQ. 0) SA = -1D0
               IF (M .GT. 0) P(M) = P(M) + E(A)
               IF (M .LT. 0) FC(-M) = FC(-M) + SA * E(A)
               DO 50 B = 1, 8
                  N = IEQ(B)
                  SB = SA
                  IF (N .LT. 0 .AND. MOD(B, 2) .EQ. 0) SB = -SA
                  IF (M .GT. 0 .AND. N .GE. M) THEN
                     SKY(IDIAG(N) - N + M) = SKY(IDIAG(N) - N + M)
     &                                       + S(A, B)
                  ELSE IF (M .GT. 0 .AND. N .LT. 0) THEN
                     KIC(M, -N) = KIC(M, -N) + SB * S(A, B)
                  ELSE IF (M .LT. 0 .AND. N .LT. 0) THEN
                     KC(-M, -N) = KC(-M, -N) + SB * S(A, B)
                  END IF
   50          CONTINUE
   60       CONTINUE
   70    CONTINUE
   80 CONTINUE
C     The component that the symmetry holds stays as a decoupled row.
      KC(NC, NC) = 1D0
      END

C     Stiffness of a rectangle W x H, plane strain, 2 x 2 Gauss points.
      SUBROUTINE ELEMNT(W, H, S)
      DOUBLE PRECISION W, H, S(8, 8), CX(4), CY(4), DX(4), DY(4)
      DOUBLE PRECISION G, SHEAR, AXIAL, CROSS, V
      INTEGER A, B, IP
      DATA CX /-1D0, 1D0, 1D0, -1D0/, CY /-1D0, -1D0, 1D0, 1D0/
      SHEAR = 13000D0 / 2.4D0
      AXIAL = 2D0 * SHEAR * 0.8D0 / 0.6D0
      CROSS = 2D0 * SHEAR * 0.2D0 / 0.6D0
      G = 1D0 / SQRT(3D0)
      V = W * H / 4D0
      DO 20 B = 1, 8
         DO 10 A = 1, 8
            S(A, B) = 0D0
   10    CONTINUE
   20 CONTINUE
      DO 60 IP = 1, 4
         DO 30 A = 1, 4
            DX(A) = CX(A) * (1D0 + CY(A) * G * CY(IP)) / (2D0 * W)
            DY(A) = CY(A) * (1D0 + CX(A) * G * CX(IP)) / (2D0 * H)
   30    CONTINUE
         DO 50 B = 1, 4
            DO 40 A = 1, 4
               S(2*A-1, 2*B-1) = S(2*A-1, 2*B-1)
     &            + V * (AXIAL * DX(A) * DX(B) + SHEAR * DY(A) * DY(B))
               S(2*A-1, 2*B) = S(2*A-1, 2*B)
     &            + V * (CROSS * DX(A) * DY(B) + SHEAR * DY(A) * DX(B))
               S(2*A, 2*B-1) = S(2*A, 2*B-1)
     &            + V * (CROSS * DY(A) * DX(B) + SHEAR * DX(A) * DY(B))
               S(2*A, 2*B) = S(2*A, 2*B)
     &            + V * (AXIAL * DY(A) * DY(B) + SHEAR * DX(A) * DX(B))
   40       CONTINUE
   50    CONTINUE
   60 CONTINUE
      END

C     The factors L D L' in the place of the matrix.
      SUBROUTINE LDLT(NEQ, IDIAG, SKY)
      INTEGER NEQ, IDIAG(NEQ), I, J, K, FIRSTI, FIRSTJ
      DOUBLE PRECISION SKY(*), T
      DO 40 J = 2, NEQ
         FIRSTJ = J - (IDIAG(J) - IDIAG(J-1)) + 1
         DO 20 I = FIRSTJ + 1, J - 1
            FIRSTI = I - (IDIAG(I) - IDIAG(I-1)) + 1
            DO 10 K = MAX(FIRSTI, FIRSTJ), I - 1
               SKY(IDIAG(J)-J+I) = SKY(IDIAG(J)-J+I)
     &            - SKY(IDIAG(I)-I+K) * SKY(IDIAG(J)-J+K)
   10       CONTINUE
   20    CONTINUE
         DO 30 K = FIRSTJ, J - 1
            T = SKY(IDIAG(J)-J+K) / SKY(IDIAG(K))
            SKY(IDIAG(J)) = SKY(IDIAG(J)) - T * SKY(IDIAG(J)-J+K)
            SKY(IDIAG(J)-J+K) = T
   30    CONTINUE
   40 CONTINUE
      END

C     Solves for one right-hand side, in its place.
      SUBROUTINE BACKS(NEQ, IDIAG, SKY, B)
      INTEGER NEQ, IDIAG(NEQ), J, K, FIRST
      DOUBLE PRECISION SKY(*), B(NEQ)
      DO 20 J = 2, NEQ
         FIRST = J - (IDIAG(J) - IDIAG(J-1)) + 1
         DO 10 K = FIRST, J - 1
            B(J) = B(J) - SKY(IDIAG(J)-J+K) * B(K)
   10    CONTINUE
   20 CONTINUE
      DO 30 J = 1, NEQ
         B(J) = B(J) / SKY(IDIAG(J))
   30 CONTINUE
      DO 50 J = NEQ, 2, -1
         FIRST = J - (IDIAG(J) - IDIAG(J-1)) + 1
         DO 40 K = FIRST, J - 1
            B(K) = B(K) - SKY(IDIAG(J)-J+K) * B(J)
   40    CONTINUE
   50 CONTINUE
      END

C     Condensation: KC - KIC' K^-1 KIC and FC - KIC' K^-1 P, a solution
C     for each contact component and one for the load.
      SUBROUTINE CONDNS(NEQ, IDIAG, SKY, P, MAXEQ, NC, KIC, KC, FC, X)
      INTEGER NEQ, IDIAG(NEQ), MAXEQ, NC, I, J, K
      DOUBLE PRECISION SKY(*), P(MAXEQ), KIC(MAXEQ, NC), KC(NC, NC)
      DOUBLE PRECISION FC(NC), X(MAXEQ)
      DO 40 J = 1, NC + 1
         DO 10 K = 1, NEQ
            IF (J .LE. NC) X(K) = KIC(K, J)
            IF (J .GT. NC) X(K) = P(K)
   10    CONTINUE
         CALL BACKS(NEQ, IDIAG, SKY, X)
         DO 30 I = 1, NC
            DO 20 K = 1, NEQ
               IF (J .LE. NC) KC(I, J) = KC(I, J) - KIC(K, I) * X(K)
               IF (J .GT. NC) FC(I) = FC(I) - KIC(K, I) * X(K)
   20       CONTINUE
   30    CONTINUE
   40 CONTINUE
      END
