% SPDX-License-Identifier: MIT
% octave_iqn.m - iqn.mex beside Octave's fsolve: the example of its manual, and Chandrasekhar's H equation; evaluations
1;
function y = manual (x)
  global calls
  calls++;
  y = zeros (2, 1);
  y(1) = -2*x(1)^2 + 3*x(1)*x(2) + 4*sin (x(2)) - 6;
  y(2) = 3*x(1)^2 - 2*x(1)*x(2)^2 + 3*cos (x(1)) + 4;
end
function h = chandrasekhar (x)
  global calls
  calls++;
  n = numel (x);
  m = ((1:n)' - 0.5) / n;
  h = 1 ./ (1 - 0.4975 / n * (m ./ (m + m')) * x);
end
function [x, done] = solve (H, x, omega)
  q = iqn ("make", numel (x), 20);
  q = iqn ("set", q, "tol_relative", 1e-10);
  q = iqn ("set", q, "omega", omega);
  do
    [q, x, done] = iqn ("step", q, x, H (x));
  until done
end
function refused (words, varargin)
  try
    [a, b] = iqn (varargin{:});
  catch error
    if isempty (strfind (error.message, words)), disp (error.message), exit (1), end
    return
  end
  printf ("not refused: %s\n", words), exit (1)
end
global calls
printf ("| problem | iqn | fsolve | difference |\n|---|---|---|---|\n")
ok = true;
options = optimset ("TolX", 1e-10, "TolFun", 1e-12);
for problem = 1:2
  if problem == 1, name = "fsolve's manual"; F = @manual; H = @(x) x + 0.1 * manual (x); x0 = [1; 2]; omega = 1; end
  if problem == 2, name = "H equation, 100"; H = @chandrasekhar; F = @(x) x - H (x); x0 = ones (100, 1); omega = 1; end
  calls = 0; [x, done] = solve (H, x0, omega); mine = calls;
  calls = 0; [y, value, info] = fsolve (F, x0, options); theirs = calls;
  difference = norm (x - y) / norm (y);
  printf ("| %s | %d | %d | %.1e |\n", name, mine, theirs, difference)
  ok = ok && done == 1 && info > 0 && difference < 1e-7 && mine < theirs;
end
% the manual's answer, and an object that was copied
ok = ok && norm (solve (@(x) x + 0.1 * manual (x), [1; 2], 1) - [0.57983; 2.54621]) < 1e-5;
q = iqn ("make", 2); x = [1; 2];
[q, x] = iqn ("step", q, x, cos (x));
[p, a] = iqn ("step", q, x, cos (x));
save ("-binary", "octave_iqn.state", "q", "x"), clear q x, load octave_iqn.state
[q, b] = iqn ("step", q, x, cos (x));
ok = ok && all (a == b) && iqn ("get", q, "iterations") == 2;
refused ("no key toll", "set", q, "toll", 1);
refused ("as many numbers", "step", q, ones (3, 1), ones (3, 1));
refused ("not finite", "step", q, b, b * NaN);
exit (! ok)
