# what command files do beside calling commands
E = 2.0e11; NU = 0.3
LAMBDA = E * NU / ((1 + NU) * (1 - 2 * NU)); MU = E / 2.0 / (1.0 + NU)
print(LAMBDA, MU, E, 1.E-3, 1.e5, 2.E+9)
# ----
listresu = []
for i in range(1, 4):
    listresu.append({'NOM': 'RESU%d' % i, 'VALE': i * 0.25})
print([r['NOM'] for r in listresu], sum(r['VALE'] for r in listresu))
# ----
P = [[0.0] * 3 for i in range(3)]
for i in range(3):
    for j in range(3):
        P[i][j] = (i + 1) * 10.0 ** -j
print(P)
# ----
def P(c):
    return 1.0e6 * c * (1 - c)
vale = []
for i in range(11):
    x = i / 10.
    vale.extend((x, P(x)))
print(tuple(vale))
# ----
grma = ('A', 'B', 'C')
loads = tuple([(g, 'PRES%s' % (k + 1)) for k, g in enumerate(grma)])
print(loads, dict(loads)['B'])
# ----
motcle = {}
motcle['GROUP_MA'] = 'HAUT'
motcle.update(dict(PRES=5.0, TYPE='X'))
def f(**args):
    return sorted(args.items())
print(f(**motcle), f(A=1, **motcle))
# ----
tab = {'INST': [0., 1., 2.], 'DX': [0.0, -4.28571, 1e-12]}
for t, d in zip(tab['INST'], tab['DX']):
    print('%12.5E %12.5E' % (t, d), '%-8s|' % ('I%d' % t))
# ----
ref = -4.28571
calc = -4.285714286
err = abs(calc - ref) / abs(ref) if abs(ref) > 1.e-30 else abs(calc)
print('OK' if err < 1.e-3 else 'NOOK', '%.3e' % err)
# ----
from math import pi, cos, sin
R = 10.; N = 8
pts = [(R * cos(2 * pi * k / N), R * sin(2 * pi * k / N)) for k in range(N)]
print(['%.3f,%.3f' % p for p in pts])
# ----
A = 1; B = 2.
if A == 1 and not B > 3 or False: print('un')
print(A <= B <= 2, A is not None, (A, B) != (1, 2.), 'x' if A else 'y')
# ----
pas = 0.1; t = 0.; inst = []
while t < 0.5 - 1e-9:
    t += pas
    inst.append(round(t, 10))
print(inst, len(inst), inst[-1])
# ----
noms = 'N1 N2 N3'.split()
print(noms, ['%s_%s' % (a, b) for a in noms for b in noms if a < b], dict.fromkeys(noms, 0.0))
# ----
titre = """ ligne 1
 ligne 2 : %s
""" % 'valeur'
print(titre.strip().splitlines(), titre.count('\n'))
# ----
lst = [3.5, 1.25, 2]
mini, maxi = min(lst), max(lst)
print(mini, maxi, lst.index(maxi), sorted(lst)[len(lst) // 2], sum(lst) / len(lst))
# ----
def verif(VAL_CAL, VAL_REF):
    VALEUR = VAL_CAL
    if abs(VAL_REF) > 1.0e-30:
        VALEUR = (VAL_CAL - VAL_REF) / VAL_REF * 100.0
    return VALEUR
print(verif(1.01, 1.0), verif(1e-31, 0.0), verif(-2, -2))
# ----
res = [None] * 4
for i in (0, 2): res[i] = 'R%d' % i
print(res, [r for r in res if r is not None], res.count(None))
# ----
i = 7
if i in (0, 1, 4, 5): print('a')
elif i == 7:
    if not i % 2 == 0: print('impair', i // 2, i / 2)
# ----
d = {}
for mot in "le chat et le chien et la souris".split():
    d[mot] = d.get(mot, 0) + 1
print(sorted(d.items(), key=lambda kv: (-kv[1], kv[0])))
# ----
def newton(f, df, x, tol=1e-12, nmax=50):
    for it in range(nmax):
        dx = -f(x) / df(x)
        x += dx
        if abs(dx) < tol: return x, it
    raise RuntimeError('no convergence')
print(newton(lambda x: x * x - 2, lambda x: 2 * x, 1.0))
# ----
def dicho(f, a, b):
    fa = f(a)
    while b - a > 1e-12:
        m = (a + b) / 2
        fm = f(m)
        if (fm > 0) == (fa > 0): a, fa = m, fm
        else: b = m
    return a
print('%.10f' % dicho(lambda x: x ** 3 - 2, 0.0, 2.0))
# ----
mat = [[2., 1.], [1., 3.]]; b = [3., 5.]
det = mat[0][0] * mat[1][1] - mat[0][1] * mat[1][0]
x = [(b[0] * mat[1][1] - b[1] * mat[0][1]) / det, (b[1] * mat[0][0] - b[0] * mat[1][0]) / det]
print(det, x)
# ----
def trace(*noms, **options):
    sep = options.pop('sep', ', ')
    return sep.join(noms) + str(sorted(options))
print(trace('a', 'b'), trace('a', 'b', sep='-', z=1, y=2))
# ----
try:
    valeurs = [1.0, 2.0]
    print(valeurs[2])
except IndexError as err:
    print('erreur : ' + str(err))
except Exception: print('autre')
# ----
is_ok = 0
fmt_raison = '-' * 20 + '\nRaison : %s\n' + '-' * 20
try:
    raise ValueError('pas de convergence')
except ValueError as err:
    print(fmt_raison % str(err)); is_ok = 1
print(is_ok)
# ----
x, y, z = (1., 2., 3.)
norme = (x ** 2 + y ** 2 + z ** 2) ** 0.5
print(norme, [round(c / norme, 6) for c in (x, y, z)])
# ----
couples = [(a, b) for a in range(3) for b in range(3) if a != b]
print(len(couples), couples[::2], couples[-1][0], [a for a, _ in couples][:3], sum(a * b for a, b in couples))
# ----
s = 0
for n, v in enumerate([0.5, 0.25, 0.125], 1):
    s += n * v
else:
    s *= 2
print(s, n, v)
# ----
print('%s : %g' % ('pi', 3.14159265), '%8.3g|%-12.4e|%+05d' % (1e5, 12345.678, 42), '{:>12.4e}'.format(1.0), '{0:<6}{1:>6}'.format('ab', 12))
# ----
texte = 'NOEUD;DX;DY\nN1;0.5;-1.25\nN2;1.5;2e3\n'
lignes = [l.split(';') for l in texte.splitlines()]
entete, donnees = lignes[0], lignes[1:]
print([dict(zip(entete, [l[0]] + [float(v) for v in l[1:]])) for l in donnees])
# ----
f = {'a': lambda x: x + 1, 'b': lambda x: x * 2}
print([f[k](3) for k in sorted(f)], f['a'](f['b'](1)))
# ----
class_names = []; append = class_names.append
for n in 'xyz': append(n.upper())
print(class_names, ''.join(class_names), append is not None)
# ----
u = 3; v = 4.0; w = '5'
print(u + v, str(u) + w, int(w) + u, float(w) / u, u * w, [u] * 2, bool(u), u ** v, -u // 2, u % 2 == 1)
# ----
liste = [1, 2, 3, 4, 5, 6]
print([x ** 2 for x in liste if x % 2 == 0], [(x, 'pair') if x % 2 == 0 else (x, 'impair') for x in liste][:2], list(filter(lambda x: x > 4, liste)), list(map(lambda x: x / 2, liste)))
# ----
if 1:
    var = 'dans le bloc'
for k in range(1): interne = k
print(var, interne, k)
# ----
a = 5
def g():
    a = 6
    def h():
        global a
        a = 7
    h()
    return a
print(g(), a)
# ----
def moyenne(valeurs, poids=None):
    """Moyenne ponderee."""
    if poids is None:
        poids = [1] * len(valeurs)
    return sum(v * p for v, p in zip(valeurs, poids)) / float(sum(poids))
print(moyenne([1, 2, 3]), moyenne([1, 2], poids=(3, 1)), moyenne(range(10)))
# ----
tuples = ((1, 'a', 2.0), (3, 'b', 4.5))
for n, nom, val in tuples: print(n, nom, val, sep='|')
print(list(zip(*tuples)), tuples[1][1:], tuples[-1][::-1])
# ----
n = 27; suite = [n]
while n != 1:
    n = n // 2 if n % 2 == 0 else 3 * n + 1
    suite.append(n)
print(len(suite), max(suite), suite[:5])
# ----
primes = [p for p in range(2, 50) if all(p % q for q in range(2, int(p ** 0.5) + 1))]
print(primes)
# ----
def pgcd(a, b):
    while b: a, b = b, a % b
    return a
print(pgcd(1071, 462), pgcd(2 ** 80, 6 ** 40), pgcd(0, 5))
# ----
o = {'x': [1, {'y': (2, 3)}]}
o['x'][1]['y'] += (4,); o['x'].append(o['x'][0]); print(o, o['x'][1]['y'][-1])
# ----
print(True and 'a' or 'b', None or 0 or [] or 'fin', 0 == False, 1 == True, '' == 0, not (1 > 2) and 3, (1 > 2) | (3 > 2), 5 > 3 == True)
# ----
print(1_000 + 0x10 + 0b11, 1e3 == 1000, 0.1 + 0.2 != 0.3, round(0.1 + 0.2, 2) == 0.3, 7 // 2 * 2 + 7 % 2, 2 ** -2, -2 ** 2, (-2) ** 2, 2 ** 0.5)
# ----
texte = 'abcdef'
print(texte[1:-1], texte[-3:], texte[::2], texte.find('cd'), 'cd' in texte, texte.upper()[0] + texte[1:], '-'.join(texte[:3]), len(texte) * '=')
# ----
rows = [('N%d' % (i + 1), i * 0.5, (-1) ** i) for i in range(4)]
for nom, x, s in rows:
    print(f'{nom:<4}|{x:>8.3f}|{s:+d}')
# ----
donnees = {'b': [2, 1], 'a': [3]}
print({k: sorted(v) for k, v in sorted(donnees.items())}, [(k, i) for k in donnees for i in donnees[k]], max(donnees.items(), key=lambda kv: len(kv[1])))
# ----
e1 = ValueError('un'); erreurs = []
for e in (e1, KeyError('deux'), ZeroDivisionError()):
    try:
        raise e
    except (ValueError, LookupError) as err:
        erreurs.append(str(err))
    except ArithmeticError as err:
        erreurs.append(type(err).__name__)
print(erreurs)
# ----
def f(x, acc=()):
    return acc if x == 0 else f(x - 1, acc + (x,))
print(f(5), f(0), f(2, acc=('z',)))
# ----
a = 'x'
b = a if a else None
c = [a] if a != 'y' else []
d, *e = c * 3
print(b, c, d, e, a == b is not None)
# ----
nombre = 1234567.891
print('{:,.2f}'.format(nombre), '%.1e' % nombre, str(nombre), '%d' % nombre, round(nombre), round(nombre, -3), int(nombre) // 1000, format(nombre, '15.3f'))
