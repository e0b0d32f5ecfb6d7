a = [1, 2, 3]
a.append(4); a.extend([5, 6]); a.insert(0, 0); a.insert(-1, 'x'); a.insert(100, 'end'); print(a)
print(a.pop(), a.pop(0), a.pop(-2), a); a.remove(3); print(a, a.index(2), a.count(2)); a.reverse(); print(a); a.clear(); print(a)
# ----
a = [3, 1, 2]
a.sort(); print(a); a.sort(reverse=True); print(a); a.sort(key=lambda x: -x); print(a, sorted(a), sorted(a, key=str), sorted('bca'), sorted({3: 1, 1: 2}))
# ----
a = [1, 2, 3]; b = a; b.append(4); c = a[:]; c.append(5); d = list(a); e = a.copy(); print(a, b, c, a is b, a is c, a == b, d is a, e)
# ----
a = list(range(10))
print(a[2:5], a[:3], a[7:], a[::3], a[::-1], a[8:2:-2], a[-3:], a[:-3], a[-100:100], a[5:5], a[3:1])
a[2:5] = ['x']; print(a); a[1:1] = [9, 9]; print(a); a[::2] = [0] * len(a[::2]); print(a); a[5:] = []; print(a); del a[0]; del a[1:3]; print(a)
# ----
a = list(range(10)); del a[::2]; print(a); del a[-1]; print(a); del a[::-1]; print(a)
# ----
a = [1, 2]; a += [3]; a += (4, 5); a += 'ab'; a *= 2; print(a, a + [1], [0] * 3, 2 * [1, 2], [] + [])
# ----
a = [1]; b = a; a += [2]; print(b); a = a + [3]; print(b, a)
# ----
print([1, 2] < [1, 3], [1, 2] < [1, 2, 0], [2] > [1, 9], [1, 'a'] == [1, 'a'], [] < [1], (1, 2) == (1, 2), (1, 2) == [1, 2], (1, 2) < (1, 3))
# ----
print(1 in [1, 2], 3 in (1, 2), '1' in [1], [1] in [[1]], 2.0 in [1, 2], None in [None])
# ----
t = (1, 2, 3)
print(t[0], t[-1], t[1:], t + (4,), t * 2, len(t), t.index(2), t.count(1), (), (1,), tuple([1, 2]), tuple(), tuple('ab'), sorted(t, reverse=True))
# ----
a, b = 1, 2; a, b = b, a; print(a, b); (c, d), e = (1, 2), 3; print(c, d, e); [f, g] = 'xy'; print(f, g)
# ----
a, *b = 1, 2, 3; print(a, b); *a, b = 1, 2, 3; print(a, b); a, *b, c = 1, 2; print(a, b, c); a, (b, *c), d = 1, (2, 3, 4), 5; print(a, b, c, d); *a, = 'abc'; print(a)
# ----
a = b = c = [1]; a.append(2); print(a, b, c); x = y = 5; x += 1; print(x, y)
# ----
a = [0] * 3; i = 0; i, a[i] = 1, 5; print(i, a); a[0], a[1] = a[1], a[0]; print(a)
# ----
a = [[0] * 2] * 2; a[0][0] = 1; print(a); b = [[0] * 2 for _ in range(2)]; b[0][0] = 1; print(b)
# ----
d = {'a': 1, 'b': 2}
d['c'] = 3; print(d, len(d), d['a'], d.get('z'), d.get('z', 0), 'a' in d, 'z' in d, list(d), list(d.keys()), list(d.values()), list(d.items()))
del d['a']; print(d, d.pop('b'), d.pop('z', None), d, d.setdefault('q', []), d.setdefault('c', 0), d); d.update({'x': 1}, y=2); d.update([('z', 3)]); print(d)
# ----
d = {'a': 1}; d['b'] = 2; d['a'] = 9; print(d); del d['a']; d['a'] = 3; print(d, d.popitem(), d); d.clear(); print(d, {}, dict(), dict(a=1), dict([(1, 2)]), dict({'x': 1}, y=2), dict(zip('ab', [1, 2])))
# ----
for k, v in {'a': 1, 'b': 2}.items(): print(k, v)
for k in {'x': 1}: print(k)
for i, (k, v) in enumerate({'p': 1}.items()): print(i, k, v)
# ----
d = {1: 'a', 1.0: 'b', True: 'c', (1, 2): 'd', None: 'e', 'k': [1]}; print(d, d[1], d[(1, 2)], d[None], d[True])
# ----
print({'a': 1} == {'a': 1.0}, {'a': 1, 'b': 2} == {'b': 2, 'a': 1}, {'a': 1} != {}, {**{'a': 1}, 'b': 2}, {**{'a': 1}, **{'a': 2}}, {'a': 1} | {'b': 2})
# ----
d = {'a': {'b': [1, 2]}}; d['a']['b'][0] += 5; d['a']['c'] = d['a']['b']; print(d, d.keys(), d.values(), d.items(), d.copy() == d, dict.fromkeys('ab', 0))
# ----
s = {1, 2, 3}; s.add(4); s.discard(9); s.remove(1); print(sorted(s), len(s), 2 in s, set(), sorted(s | {9}), sorted(s & {2, 3}), sorted(s - {2}), sorted(s ^ {2, 9}), s <= {2, 3, 4, 5}, {2} < s, s == {4, 3, 2}, s.issubset([2, 3, 4]), s.isdisjoint([7]))
# ----
s = set([1, 1, 2]); s.update([5], (6,)); print(sorted(s), sorted(s.union([9])), sorted(s.intersection([1, 5])), sorted(s.difference([1])), frozenset([1]), {frozenset([1]): 2}[frozenset([1])], sorted(set('hello')), {1} | {1.0})
# ----
print([x * x for x in range(5)], [x for x in range(10) if x % 2 if x > 3], [(x, y) for x in range(2) for y in 'ab'], [[i for i in range(j)] for j in range(3)], [a + b for a, b in [(1, 2), (3, 4)]])
# ----
print({x: x * x for x in range(3)}, sorted({x % 3 for x in range(9)}), sum(x for x in range(5)), list(x for x in 'ab'), dict((k, v) for k, v in [('a', 1)]), any(x > 2 for x in [1, 3]), all(x for x in []), tuple(i for i in range(3)))
# ----
x = 'outer'; l = [x for x in range(3)]; print(x, l); n = 3; print([n * i for i in range(n)], [y for y in [n] for n in range(2)])
# ----
g = (i * i for i in range(3)); print(next(g), list(g), list(g), next(g, 'done'))
# ----
it = iter([1, 2]); print(next(it), next(it), next(it, None)); z = zip([1, 2], 'ab'); print(next(z), list(z)); print(list(zip()), list(zip([1], [])), list(zip([1, 2], [3, 4], [5, 6])))
# ----
print(list(map(lambda x, y: x + y, [1, 2], [3, 4])), list(filter(None, [0, 1, '', 'a'])), list(filter(lambda x: x > 1, [1, 2, 3])), list(enumerate(['a'], 5)), list(reversed([1, 2])), list(map(int, '123')))
# ----
print(range(5), list(range(5)), list(range(2, 5)), list(range(5, 0, -2)), list(range(0)), len(range(0, 10, 3)), range(10)[2], range(10)[-1], range(10)[2:5], 3 in range(5), 3.0 in range(5), 7 in range(0, 10, 2), range(0, 10, 3)[::-1], range(3) == range(0, 3, 1), range(0) == range(2, 1))
# ----
print(min([3, 1, 2]), max('a', 'c', 'b'), min([], default=0), max([1, -5], key=abs), min({'b': 1, 'a': 2}), sum([1.5, 2]), sum(((1,), (2,)), ()), sorted([(2, 'a'), (1, 'b')]), max([(1, 2), (1, 3)]))
# ----
print(sorted(['b', 'A', 'c'], key=str.lower), sorted([3, 1, 2], key=lambda v: -v), sorted([(1, 'b'), (1, 'a'), (0, 'z')], key=lambda p: p[0]), sorted([1, 2, 3, 4], key=lambda v: v % 2, reverse=True))
# ----
print(bool([]), bool([0]), bool({}), bool(''), bool('0'), bool(0.0), bool(None), bool((0,)), bool(range(0)), bool(set()), not {1: 2})
# ----
print([1, [2, [3, ()]], {'a': (1,)}], str([1.0, 'a', None, True]), repr((1, 'x')), [[]], [''], ({},), {1, })
# ----
print(*[1, 2], *'ab', [*range(3), *[9]], (*[1], 2), {*[1], *[1]}, *[])
# ----
a = [1, 2, 3]; a[0] += 10; a[-1] *= 2; print(a); d = {}; d['n'] = d.get('n', 0) + 1; d['n'] += 1; print(d)
# ----
a = [3, 1, 2]; print(sorted(a) == [1, 2, 3], a, list(reversed(sorted(a))), a[::-1], len(a), a.index(1), [i for i, v in enumerate(a) if v > 1])
# ----
matrix = [[1, 2, 3], [4, 5, 6]]; print([list(r) for r in zip(*matrix)], [row[1] for row in matrix], sum(sum(r) for r in matrix), [x for row in matrix for x in row])
# ----
print(type([]).__name__, type(()) == tuple, type({}) is dict, isinstance([], (list, tuple)), isinstance(True, int), isinstance(1, float), type(1) == type(2), type(None).__name__, int, type('a'), list)
# ----
k = ['b', 'a']; v = [1, 2]; d = dict(zip(k, v)); print(d, sorted(d.items()), sorted(d, key=d.get, reverse=True), max(d, key=d.get), {v: k for k, v in d.items()}, list(d)[0], ', '.join('%s=%s' % kv for kv in sorted(d.items())))
# ----
class_ = None; l = []; l2 = l; l2 += [1]; print(l, l is l2, [] is [], () == (), None is None, 1 is not None, 'a' is not None)
# ----
a = [1, 2, 3, 4]
for x in a:
    if x == 2: a.append(99)
    if len(a) > 6: break
print(a)
# ----
a = [5, 6]; i = iter(a); print(list(i), list(i)); print(list(iter('ab')), slice(1, 2), [1, 2, 3][slice(1, None)], 'abc'[slice(0, 2)])
