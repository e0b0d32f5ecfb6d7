import copy
a = [1, [2, 3], {'k': [4]}]
b, c = copy.copy(a), copy.deepcopy(a)
a[1].append(5); a[2]['k'].append(6); a.append(7)
print(a, b, c)
shared = [0]
d = copy.deepcopy((shared, shared, {1: shared}))
shared.append(1); d[0].append(2)
print(d, d[0] is d[1], d[0] is d[2][1])
loop = [1]
loop.append(loop)
twin = copy.deepcopy(loop)
print(twin, twin[1] is twin, copy.copy('a'), copy.copy({1, 2}), copy.deepcopy((1, 'a', None, 2.5)))
loop.clear(); twin.clear()  # nothing counts what holds itself
# ----
from itertools import product, chain, combinations, permutations, zip_longest, count, islice, repeat, accumulate
import itertools
print(list(product('ab', (1, 2))), list(product((0, 1), repeat=2)), list(product()), list(product('a', ())), len(list(product(range(3), range(4), range(5)))))
print(list(chain('ab', [1], ())), list(chain()), list(itertools.chain.from_iterable([[1, 2], (3,)])), list(chain(*[[i] * i for i in range(4)])))
print(list(combinations('abcd', 2)), list(combinations([1, 2, 3], 3)), list(combinations([1], 2)), list(combinations('ab', 0)))
print(list(permutations('abc')), list(permutations(range(4), 2))[:5], len(list(permutations(range(5)))), list(permutations('a', 2)), list(permutations('ab', 0)))
print(list(zip_longest('abc', [1], fillvalue='-')), list(zip_longest([1], [2, 3])), list(zip_longest()))
print(list(islice(count(), 3)), list(islice(count(10, -2), 1, 4)), list(islice('abcdefg', 1, None, 3)), list(islice('abc', 0)), list(islice(count(0.5), 2)), list(islice([1, 2], 5)))
print(list(repeat('x', 3)), list(accumulate([1, 2, 3])), list(accumulate([1, 2, 3], lambda a, b: a * b)), list(zip(count(1), 'ab')))
it = iter(range(10))
print(list(islice(it, 2)), list(islice(it, 2, 4)), next(it))
# ----
from functools import reduce
from operator import itemgetter, add, mul
import operator as op
print(reduce(add, [1, 2, 3]), reduce(mul, range(1, 6), 1), reduce(lambda a, b: a + b, ['a', 'b'], ''), reduce(max, [3, 9, 2]))
rows = [('b', 2), ('a', 3), ('a', 1)]
print(sorted(rows, key=itemgetter(0)), sorted(rows, key=itemgetter(0, 1)), list(map(itemgetter('x'), [{'x': 1}, {'x': 2}])), itemgetter(1)('abc'))
print(op.sub(3, 1), op.truediv(1, 4), op.neg(2), op.lt(1, 2), op.eq('a', 'a'), op.pow(2, 10), op.mod(7, 3))
try:
    reduce(add, [])
except TypeError as e:
    print(e)
# ----
from collections import OrderedDict, defaultdict
d = OrderedDict()
d['b'] = 1
d['a'] = 2
print(list(d.items()), list(OrderedDict([('x', 1), ('y', 2)]).keys()), d == {'a': 2, 'b': 1})
counts = defaultdict(int)
for letter in 'abca':
    counts[letter] += 1
groups = defaultdict(list)
for key, value in [(1, 'a'), (2, 'b'), (1, 'c')]:
    groups[key].append(value)
print(dict(counts), dict(groups), groups, 'z' in counts, counts.get('z'), len(counts), counts['z'], len(counts))
print(defaultdict(lambda: 'none')['x'], defaultdict(list, {'a': [1]})['a'], isinstance(groups, dict))
try:
    defaultdict()['x']
except KeyError as e:
    print('missing', e)
# ----
from __future__ import print_function, division
import string
print(string.ascii_lowercase, string.ascii_uppercase[:3], string.ascii_letters[24:28], string.digits, string.hexdigits, string.octdigits, string.punctuation, repr(string.whitespace), len(string.printable))
# ----
import time, random, datetime as dt, os, subprocess
from collections import Counter, namedtuple
import json as js
from pathlib import Path
import xml.dom
print('nothing of them is used')
# ----
try:
    import no_such_module_anywhere
    print('there')
except ImportError as e:
    print(type(e).__name__, e)
