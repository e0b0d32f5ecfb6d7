x = 'global'
def f():
    def g(): return x
    x = 'f'
    return g()
print(f(), x)
# ----
def f():
    try: print(y)
    except NameError as e: print(e)
f()
y = 1
def f():
    print(y)
f()
# ----
def f(n):
    def g(): return n
    n += 1
    return g
print(f(1)(), f(5)())
# ----
def f():
    for i in range(3): pass
    return i
print(f())
# ----
def f():
    def g():
        return v
    try: g()
    except NameError as e: print(type(e).__name__, e)
    v = 1
    return g()
print(f())
# ----
funcs = {}
for n in ('a', 'b'):
    def fn(suffix, n=n): return n + suffix
    funcs[n] = fn
print(funcs['a']('!'), funcs['b']('?'), fn('.'))
# ----
def f(x):
    return [x + y for y in range(x) if y != x - 1], {x: y for y in 'ab'}
print(f(3))
# ----
i = 5
print([i for i in range(3)], i, {i: 1 for i in 'a'}, i, list(map(lambda i: i * 2, [1])), i)
# ----
def f():
    global newvar
    newvar = 3
f()
print(newvar)
# ----
def outer():
    a = []
    def add(v):
        a.append(v)
        return a
    def reset():
        nonlocal a
        a = []
    add(1); add(2); reset(); return add(3)
print(outer())
# ----
def f():
    x = 1
    del x
    try: x
    except UnboundLocalError as e: print(e)
f()
# ----
def f(a=1, *, b=2): return a + b
g = f; f = None
print(g(), g(3), g(b=5), g(1, b=1))
# ----
try:
    raise ValueError('v')
except ValueError as e:
    pass
try: e
except NameError as n: print(n)
# ----
def fib(n, memo={}):
    if n in memo: return memo[n]
    memo[n] = n if n < 2 else fib(n - 1) + fib(n - 2)
    return memo[n]
print(fib(80), fib(10))
# ----
def compose(*fs):
    def run(x):
        for f in reversed(fs): x = f(x)
        return x
    return run
print(compose(lambda x: x + 1, lambda x: x * 10)(5), compose()(7))
# ----
def f(): return g()
def g(): return 'late'
print(f())
# ----
len_ = len
def len(x): return 'mine'
print(len([1]), len_([1]))
# ----
def f(list): return list
print(f([1]), list('a'))
# ----
a = lambda: (yield_ for yield_ in range(2)); print(list(a())); print((lambda *a: len(a))(1, 2, 3), (lambda **k: sorted(k))(b=1, a=2))
# ----
def curry(f): return lambda a: lambda b: f(a, b)
print(curry(lambda a, b: a - b)(10)(3))
# ----
def f():
    x = 1
    def g():
        def h():
            nonlocal x
            x = x + 1
        h()
    g()
    return x
print(f())
# ----
gen = ((i, j) for i in range(2) for j in range(i + 1)); print(next(gen)); print(list(gen))
def first(pred, seq): return next((s for s in seq if pred(s)), None)
print(first(lambda s: s > 2, [1, 2, 3, 4]), first(lambda s: s > 9, [1]))
# ----
n = 3
def check(f):
    try: print(f())
    except Exception as e: print(type(e).__name__, e)
check(lambda: [n for _ in range(n)]); check(lambda: sum(n for _ in range(n))); check(lambda: undefined + 1); check(lambda: [undefined for _ in range(1)])
# ----
def f(x):
    if x: y = 1
    return y
print(f(1))
try: f(0)
except UnboundLocalError as e: print(e)
# ----
it = iter(range(4))
print([(a, next(it)) for a in it])
print(sorted({k for k in 'hello' if k not in 'l'}), [w for w in ['a', ''] if w], {len(w): w for w in ['a', 'bb', 'cc']})
# ----
log = []
def t(v): log.append(v); return v
t(1) and t(0) and t(2); t(0) or t(3) or t(4); t(1) < t(5) < t(2) < t(9); [t('a'), t('b')][t(0)]; {t('k'): t('v')}; t(7) if t(0) else t(8)
print(log)
# ----
log = []
def t(v): log.append(v); return v
def f(*a, **k): return None
f(t(1), *t([2]), k=t(3), **t({'z': 4})); t([0])[t(0)] = t(5); print(log, t(2) ** t(3), t(1) in t([1]))
