% The README's first program in GNU Octave; run by octave.sh.

function check (passed, what)
  printf ("  %s  %s\n", ifelse (passed, "PASS", "FAIL"), what);
  if (! passed)
    exit (1);
  endif
endfunction

function text = ifelse (condition, yes, no)
  text = no;
  if (condition)
    text = yes;
  endif
endfunction

function refused (words, varargin)
  said = "";
  try
    signorini_solve (varargin{:});
  catch reason
    said = reason.message;
  end_try_catch
  check (! isempty (strfind (said, words)), ["refused: " words]);
endfunction

K = [4 1 -1 0; 1 4 0 -1; -1 0 4 1; 0 -1 1 4];
f = [2 1.5 3 0.5];
[d, F, state, eta] = signorini_solve (K, f, 0, 0.3);
names = {"open", "slip", "stick"};
for i = 1:2
  printf ("pair %d %-5s d_n %.4f d_t %.4f  F_n %.4f F_t %.4f\n", i, ...
          names{state(i) + 1}, d(:,i), F(:,i));
endfor
check (eta <= 1e-10, "solved");
check (norm (K * d(:) - f(:) - F(:)) <= 1e-12, "equilibrium");
check (isequal (state, [1 2]), "the first pair slips, the second sticks");
check (abs (F(2,1) - 0.3 * F(1,1)) <= 1e-12, "friction of the first");
[d, F] = signorini_solve (2 * eye (3), [1 3 4], 0, 0.5, 3);
check (norm (F - [-1; -0.3; -0.4]) <= 1e-9, "in 3D: on the cone, against the motion");
[d, F, state] = signorini_solve (K, f, 0, 5, 2, [0.01 0.02]);
check (isequal (state, [2 2]) && isequal (d(2,:), [0.01 0.02]), "reference slip of the step before");

refused ("K[1,1] is not finite", diag ([1 NaN]), [1 1], 0, 0);
refused ("mu[0] is -1", K, f, 0, [-1 0]);
refused ("f has 3 entries: give 4, dim for each pair", K, [1 2 3], 0, 0.3);
refused ("gap has 4 entries: give 2, one for each pair", K, f, [0 0 0 0], 0.3);
refused ("slip0 has 4 entries: give 2", K, f, 0, 0.3, 2, f);
refused ("K is complex: give real numbers", K + 1i * eye (4), f, 0, 0.3);
refused ("gap is complex", K, f, 1i, 0.3);
refused ("K must be square", ones (3), [1 2 3], 0, 0.3);
refused ("K is not a real matrix", "abc", [1 2 3], 0, {});
