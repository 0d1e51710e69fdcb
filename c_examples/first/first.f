C     A body touches a plane with two pairs, in Fortran 77.
C
      PROGRAM FIRST
      INCLUDE 'signorini.inc'
      DOUBLE PRECISION K(4, 4), F(4), GAP(2), MU(2), SLIP(2)
      DOUBLE PRECISION D(4), R(4), ETA
      INTEGER STATE(2), ITER, INFO, I
      CHARACTER*5 NAME(0:2)
      CHARACTER*200 TEXT
      DATA NAME /'open ', 'slip ', 'stick'/
C     Loads: > 0 in n presses on the obstacle.
      DATA K /4D0, 1D0, -1D0, 0D0, 1D0, 4D0, 0D0, -1D0,
     &        -1D0, 0D0, 4D0, 1D0, 0D0, -1D0, 1D0, 4D0/
      DATA F /2D0, 1.5D0, 3D0, 0.5D0/
      DATA GAP /2*0D0/, MU /2*0.3D0/, SLIP /2*0D0/

      CALL SGSOLV(2, 2, K, 4, F, GAP, MU, SLIP, 0, 1D-12, 0,
     &            D, R, STATE, ETA, ITER, INFO)
      IF (INFO .NE. 0) THEN
         CALL SGMESG(TEXT, 200)
         WRITE (*, *) 'INFO =', INFO, ': ', TEXT
         STOP 1
      END IF
      DO 10 I = 1, 2
         WRITE (*, 20) I, NAME(STATE(I)), D(2*I - 1), D(2*I),
     &                 R(2*I - 1), R(2*I)
   10 CONTINUE
   20 FORMAT ('pair ', I1, ' ', A5, ' d_n ', F6.4, ' d_t ', F6.4,
     &        '  F_n ', F7.4, ' F_t ', F7.4)
      END
