import math
print(math.pi, math.e, math.sqrt(2), math.sin(1), math.cos(1), math.tan(1), math.atan2(1, 2), math.hypot(3, 4), math.exp(1), math.log(10), math.log(8, 2), math.log10(1000), math.log2(8))
# ----
from math import *
print(sqrt(16), floor(2.7), ceil(2.1), trunc(-2.7), floor(-2.5), fabs(-3), pow(2, 3), factorial(20), factorial(30), gcd(12, 18), lcm(4, 6), degrees(pi), radians(180), copysign(1, -0.0), fmod(-7, 3), isclose(0.1 + 0.2, 0.3), isnan(nan), isinf(inf))
# ----
from math import sin as s, pi
import math as m
print(s(pi / 6), m.asin(0.5), m.acos(0.5), m.sinh(1), m.cosh(1), m.tanh(1), m.asinh(1), m.acosh(2), m.atanh(0.5), m.erf(0.5), m.gamma(5), round(m.lgamma(10), 12), m.expm1(1e-10), m.log1p(1e-10), m.frexp(8.5), m.ldexp(0.5, 3), m.modf(3.25))
# ----
import math
print(math.comb(10, 3), math.perm(5, 2), math.isqrt(10**20), math.prod([1, 2, 3]), math.fsum([0.1] * 10), math.dist((0, 0), (3, 4)), math.remainder(7, 3), math.tau, math.inf, -math.inf, math.floor(1e20), math.log(2**200), math.cbrt(27))
# ----
import math
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
check(lambda: math.sqrt(-1)); check(lambda: math.log(0)); check(lambda: math.exp(1000)); check(lambda: math.acos(2)); check(lambda: math.factorial(-1)); check(lambda: math.sqrt('a')); check(lambda: math.pow(0, -1)); check(lambda: math.floor(float('nan'))); check(lambda: math.fmod(1, 0)); check(lambda: math.foo)
# ----
import os.path
from os.path import join, basename
print(join('a', 'b', '/c', 'd'), basename('/x/y.med'), os.path.dirname('/x/y.med'), os.path.splitext('a/b.tar.gz'), os.path.splitext('.rc'), os.path.join('a/', 'b'), os.path.dirname('file'))
# ----
import sys
print(sys.maxsize)
sys.exit(0)
print('never')
# ----
from math import (sin, cos,
                  tan)
import math, sys
print(sin(0) + cos(0) + tan(0), round(math.sin(math.pi / 4), 10))
# ----
import math
print('%.6f' % math.sin(0.3), ['%.3e' % math.exp(-x) for x in range(0, 50, 10)], max(math.cos(t / 10) for t in range(10)), sum(math.sqrt(i) for i in range(10)))
