C     Two bars in a row along x, from a whole sparse matrix, in
C     Fortran 77: bar A pushes on bar B across a gap.
C
C     wall 1|--A--o2   gap   3o--B--|4 wall
C     Node I has the degrees of freedom 2 I - 1 and 2 I.
C
      PROGRAM SPARSE
      INCLUDE 'signorini.inc'
      INTEGER COLPTR(9), ROWIND(12), FIXED(4), SLAVE(2), MSTART(2)
      INTEGER MASTER(2), STATE(1), ITER, INFO, DONE
      INTEGER*8 HANDLE
      DOUBLE PRECISION VALUES(12), WEIGHT(1), NORMAL(2), TANGNT(1),
     &   F(8), PRESC(4), GAP(1), MU(1), SLIP0(1), D(2), R(2), U(8), ETA
      CHARACTER*200 TEXT
C     Each bar: 100 along x, 10 along y. Lower triangle by columns,
C     rows ascending.
      DATA COLPTR /1, 3, 5, 6, 7, 9, 11, 12, 13/
      DATA ROWIND /1, 3, 2, 4, 3, 4, 5, 7, 6, 8, 7, 8/
      DATA VALUES /1D2,-1D2,1D1,-1D1,1D2,1D1,1D2,-1D2,1D1,-1D1,1D2,1D1/
C     One pair: node 2 faces node 3; its outward normal is x, so that
C     its tangent is y. The load acts on node 2.
      DATA SLAVE /3, 4/, MSTART /1, 2/, MASTER /5, 6/, WEIGHT /1D0/
      DATA FIXED /1, 2, 7, 8/, PRESC /4*0D0/, NORMAL /1D0, 0D0/
      DATA F /2*0D0,30D0,6D0,4*0D0/, GAP /.1D0/, MU /.2D0/, SLIP0 /0D0/

      CALL SGSPAR(8, 12, COLPTR, ROWIND, VALUES, 0, 4, FIXED, 2, 1,
     &            SLAVE, 1, MSTART, MASTER, WEIGHT, NORMAL, 0, TANGNT,
     &            HANDLE, INFO)
      IF (INFO .EQ. 0) CALL SGCASE(HANDLE, F, PRESC, GAP, SGCOUL, MU,
     &            SLIP0, 0, 0D0, 0, D, R, STATE, ETA, ITER, INFO)
      IF (INFO .EQ. 0) CALL SGRECV(HANDLE, F, PRESC, D, U, INFO)
      IF (INFO .NE. 0) THEN
         CALL SGMESG(TEXT, 200)
         WRITE (*, *) 'INFO =', INFO, ': ', TEXT
         STOP 1
      END IF
      WRITE (*, 10) R, U(3), U(4), U(5), U(6)
   10 FORMAT ('F_n ', F8.4, ' F_t ', F7.4, '  node 1', 2(1X, F6.4),
     &        '  node 2', 2(1X, F6.4))
      CALL SGFREE(HANDLE, DONE)
      END
