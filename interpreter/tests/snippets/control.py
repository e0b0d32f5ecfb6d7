for i in range(5):
    if i == 1: continue
    if i == 3: break
    print(i)
else:
    print('no')
for i in []: pass
else: print('else', 'i' in dir() if False else 'x')
# ----
i = 0
while i < 3:
    i += 1
    if i == 2: continue
    print(i)
else:
    print('end', i)
while True:
    break
else:
    print('never')
# ----
def f(x, y=2, *args, z=3, **kw):
    return x, y, args, z, kw
print(f(1), f(1, 5), f(1, 2, 3, 4), f(1, z=9), f(1, a=1, b=2), f(*[1, 2, 3], **{'z': 4, 'q': 5}), f(y=1, x=0))
# ----
def f(a, b=[]):
    b.append(a)
    return b
print(f(1), f(2), f(3, []))
# ----
def outer():
    x = 1
    def inner():
        nonlocal x
        x += 1
        return x
    inner(); inner()
    return x
print(outer())
# ----
def make_counter():
    n = 0
    def count():
        nonlocal n
        n += 1
        return n
    return count
a, b = make_counter(), make_counter(); print(a(), a(), b(), a())
# ----
x = 1
def f():
    global x
    x += 1
def g():
    x = 10
    return x
f(); print(x, g(), x)
# ----
fs = [lambda: i for i in range(3)]; print([f() for f in fs]); fs = [lambda i=i: i for i in range(3)]; print([f() for f in fs])
# ----
def fact(n): return 1 if n <= 1 else n * fact(n - 1)
def fib(n):
    a, b = 0, 1
    for _ in range(n): a, b = b, a + b
    return a
print(fact(50), fib(200), fact(5))
# ----
def even(n): return n == 0 or odd(n - 1)
def odd(n): return n != 0 and even(n - 1)
print(even(100), odd(7))
# ----
def f(): pass
def g(): return
def h(): return 1, 2
print(f(), g(), h(), (lambda: None)(), (lambda *a, **k: (a, k))(1, b=2))
# ----
def f(a, /, b, *, c): return a, b, c
print(f(1, 2, c=3), f(1, b=2, c=3))
# ----
try:
    1 / 0
except ZeroDivisionError as e:
    print('caught', e, type(e).__name__, repr(e), e.args)
else:
    print('else')
finally:
    print('finally')
# ----
try:
    print('body')
except ValueError:
    print('no')
else:
    print('else')
finally:
    print('finally')
# ----
def f():
    try:
        return 'try'
    finally:
        print('cleanup')
def g():
    try:
        return 'try'
    finally:
        return 'finally'
def h():
    for i in range(3):
        try:
            if i == 1: continue
            if i == 2: break
            print('loop', i)
        finally:
            print('fin', i)
    return i
print(f(), g(), h())
# ----
def f(x):
    try:
        if x == 0: raise ValueError('zero')
        if x == 1: raise KeyError('one')
        if x == 2: raise TypeError
        return 'ok'
    except ValueError as e: return 'V' + str(e)
    except (KeyError, IndexError) as e: return 'K' + str(e)
    except Exception as e: return 'E' + repr(e)
print(f(0), f(1), f(2), f(3))
# ----
try:
    try:
        raise ValueError('inner')
    except ValueError:
        raise
except ValueError as e:
    print('outer', e)
# ----
try:
    try:
        [][1]
    finally:
        print('first')
except IndexError as e:
    print(e)
# ----
try:
    try:
        int('x')
    except ValueError as e:
        raise RuntimeError('wrapped') from e
except RuntimeError as e:
    print(e)
# ----
for expr in ["1/0", "1//0", "1%0", "1.0/0", "1.0//0", "1.0%0", "0**-1", "1j/0", "divmod(1, 0)"]:
    pass
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
check(lambda: 1 / 0); check(lambda: 1 // 0); check(lambda: 1 % 0); check(lambda: 1.0 / 0); check(lambda: 1.0 // 0); check(lambda: 1.0 % 0); check(lambda: 0 ** -1); check(lambda: 1j / 0); check(lambda: 10.0 ** 400); check(lambda: (-1) ** 0.5)
# ----
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
check(lambda: [1][5]); check(lambda: (1,)[5]); check(lambda: 'a'[5]); check(lambda: {}['k']); check(lambda: {'a': 1}[2]); check(lambda: [1]['a']); check(lambda: [1][1.5]); check(lambda: [].pop()); check(lambda: [1].index(2)); check(lambda: 'a'.index('b')); check(lambda: [1].remove(3)); check(lambda: {1}.remove(2)); check(lambda: range(3)[7])
# ----
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
check(lambda: 1 + 'a'); check(lambda: 'a' + 1); check(lambda: [1] + (2,)); check(lambda: (1,) + [2]); check(lambda: 'a' * 'b'); check(lambda: 'a' * 1.5); check(lambda: None + 1); check(lambda: {} + {}); check(lambda: -'a'); check(lambda: [] - []); check(lambda: 1 < 'a'); check(lambda: None < 1); check(lambda: [1] < (1,)); check(lambda: 1j < 2j); check(lambda: 3 in 5); check(lambda: 1 in 'a'); check(lambda: {[]: 1}); check(lambda: ~1.5); check(lambda: 1.5 & 2); check(lambda: 1 << -1)
# ----
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
check(lambda: int('abc')); check(lambda: int('1.5')); check(lambda: float('x')); check(lambda: int([])); check(lambda: float(None)); check(lambda: int(float('nan'))); check(lambda: int(float('inf'))); check(lambda: len(5)); check(lambda: abs('a')); check(lambda: sum(['a'])); check(lambda: max([])); check(lambda: chr(-1)); check(lambda: ord('ab')); check(lambda: round('a')); check(lambda: next(iter([]))); check(lambda: iter(5)); check(lambda: 5()); check(lambda: None.x); check(lambda: 'a'.foo); check(lambda: [].push(1)); check(lambda: undefined_name)
# ----
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
def f(a, b, c=1): return a
def g(): pass
def h(*, k): pass
check(lambda: f()); check(lambda: f(1)); check(lambda: f(1, 2, 3, 4)); check(lambda: f(1, 2, d=3)); check(lambda: f(1, 2, a=3)); check(lambda: g(1)); check(lambda: h()); check(lambda: h(1)); check(lambda: f(1, 2, **{'c': 3}))
# ----
def check(f):
    try:
        print(f())
    except Exception as e:
        print(type(e).__name__ + ': ' + str(e))
def unpack(v):
    a, b = v
    return a, b
def unpack_star(v):
    a, b, *c = v
    return a, b, c
check(lambda: unpack([1])); check(lambda: unpack([1, 2, 3])); check(lambda: unpack(5)); check(lambda: unpack('xy')); check(lambda: unpack_star([1])); check(lambda: unpack_star('abcd')); check(lambda: ','.join([1])); check(lambda: '%d' % 'a'); check(lambda: '%s %s' % 1); check(lambda: '%s' % (1, 2)); check(lambda: '{}'.format()); check(lambda: '{a}'.format()); check(lambda: format('a', 'd')); check(lambda: format(1.5, 'd')); check(lambda: f'{1:s}')
# ----
def f():
    print(x)
    x = 1
try:
    f()
except UnboundLocalError as e:
    print(type(e).__name__, e)
# ----
try:
    assert 1 == 2, 'message %d' % 5
except AssertionError as e:
    print('assert', e)
try:
    assert []
except AssertionError as e:
    print(repr(str(e)))
assert True, 'fine'
# ----
try:
    raise ValueError('a', 1)
except ValueError as e:
    print(e, e.args, repr(e))
try:
    raise KeyError
except LookupError as e:
    print(repr(e), str(e) == '')
print(issubclass(KeyError, LookupError) if False else 'ok')
# ----
e = ValueError('kept')
try:
    raise e
except Exception as x:
    print(x is e, isinstance(x, ValueError), isinstance(x, ArithmeticError), isinstance(ZeroDivisionError(), ArithmeticError))
# ----
x = 5
if x > 3: print('big')
elif x > 1: print('mid')
else: print('small')
if x < 3: print('no')
elif x == 5:
    if True:
        print('nested')
    else:
        pass
print('yes' if x else 'no', 'a' if x > 9 else 'b' if x > 4 else 'c')
# ----
x = 1; y = 2; print(x, y); del x
try: x
except NameError as e: print(e)
a = [1, 2, 3]; del a[0], a[-1]; print(a)
# ----
print([f(2) for f in [lambda x: x, lambda x: x * x]], (lambda x, y=3: x + y)(1), sorted([1, 2, 3], key=lambda x: (x % 2, -x)))
# ----
def apply(f, *args, **kw): return f(*args, **kw)
print(apply(max, 1, 5, 3), apply(sorted, [2, 1], reverse=True), apply(lambda a, b: a - b, b=1, a=5))
# ----
def gen_table(n):
    table = {}
    for i in range(1, n + 1):
        table[i] = {'sq': i ** 2, 'name': 'n%02d' % i}
    return table
for k, row in gen_table(3).items():
    print(k, row['sq'], row['name'])
# ----
def f(n):
    if n == 0:
        return []
    rest = f(n - 1)
    rest.append(n)
    return rest
print(f(5))
# ----
total = 0
for i in range(3):
    for j in range(3):
        if j == 2: break
        if i == j: continue
        total += i * 10 + j
    else:
        print('unreached')
print(total, i, j)
# ----
x: int = 5
y: 'anything' = 'a'
def f(a: int, b: str = 'x') -> str: return b * a
print(x, y, f(2))
# ----
a = 1; \
b = 2
c = (1 +
     2)   # comment

# full comment line
if a: \
    print(a, b, c)
# ----
def f(x):
    """docstring"""
    return x
'lone string'
print(f(1)); print(1); print(2);
# ----
def deep(n): return 0 if n == 0 else 1 + deep(n - 1)
print(deep(400))
try:
    deep(100000)
except RecursionError as e:
    print('RecursionError')
# ----
while 1:
    try:
        break
    finally:
        print('left')
for i in range(2):
    try:
        continue
    finally:
        print('next', i)
# ----
try:
    raise Exception
except:
    print('bare')
try:
    try: raise ValueError(1)
    except TypeError: print('no')
    finally: print('inner finally')
except ValueError as e: print('got', e)
# ----
def f():
    yes = []
    def add(x, to=yes): to.append(x); return len(to)
    add(1); add(2)
    return yes
print(f())
# ----
x = 10
def a():
    x = 20
    def b():
        def c(): return x
        return c()
    return b()
print(a(), x)
# ----
def f(k, v=None, *rest):
    if v is None: v = []
    v += [k]
    return v
print(f(1), f(2), f(3, [0]), f(*'ab'.split('|'), [5]))
# ----
print([y for x in [[1, 2], [3]] for y in x if y != 2], [(lambda z: z + x)(1) for x in range(3)], [x for x in [1, 2, 3] if x > 1 and x < 3])
