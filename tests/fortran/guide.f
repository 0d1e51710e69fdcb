C     The subroutine of the guide's chapter of questions, in Fortran 77.
C
C     One pair in the plane with the stiffness 2, pressed by 3, friction
C     0.5: it carries 1.5 along the plane. Pushed by 1 it sticks. Pushed
C     by 2 it slips by (2 - 1.5) / 2, and sticks there when it is let go.
C     To 1D-9: results are certified to 1D-10 of forces of size one.
C
      PROGRAM GUIDE
      INCLUDE 'signorini.inc'
      DOUBLE PRECISION K(2,2), F(2), GAP(1), MU(1), SLIP0(1), D(2), R(2)
      DOUBLE PRECISION PUSH(3), HELD(3), SLIP(3)
      INTEGER STATE(1), WANTED(3), INFO, STEP
      DATA K /2D0, 0D0, 0D0, 2D0/, GAP /0D0/, MU /0.5D0/, SLIP0 /0D0/
      DATA PUSH /1D0, 2D0, 0D0/, HELD /-1D0, -1.5D0, 0.5D0/
      DATA SLIP /0D0, 0.25D0, 0.25D0/
      WANTED(1) = SGSTIC
      WANTED(2) = SGSLIP
      WANTED(3) = SGSTIC

      DO 10 STEP = 1, 3
         F(1) = 3D0
         F(2) = PUSH(STEP)
         CALL CONTAC(1, K, F, GAP, MU, SLIP0, D, R, STATE, INFO)
         IF (INFO .NE. 0 .OR. STATE(1) .NE. WANTED(STEP) .OR.
     &       ABS(D(1)) .GT. 1D-9 .OR. ABS(D(2) - SLIP(STEP)) .GT. 1D-9
     &       .OR. ABS(R(1) + 3D0) .GT. 1D-9
     &       .OR. ABS(R(2) - HELD(STEP)) .GT. 1D-9) THEN
            WRITE (*, *) 'step', STEP, ': ', INFO, STATE, D, R
            STOP 1
         END IF
         SLIP0(1) = D(2)
   10 CONTINUE
C     A stiffness that is not semi-definite is refused.
      K(1,1) = -2D0
      CALL CONTAC(1, K, F, GAP, MU, SLIP0, D, R, STATE, INFO)
      IF (INFO .NE. -3) STOP 1
      WRITE (*, *) 'guide: Fortran 77, three steps and a refusal'
      END

      INCLUDE 'questions.f'
