print('a' 'b' "c", 'it''s', "it's", 'say "hi"', 'both \' and "', repr("it's"), repr('a"b'), repr('both \' "'))
# ----
print('\n\t\\\x41\u00e9\U0001F600\101\0end'.replace('\0', '0'), r'\n\t', R'a\b', 'a\
b')
# ----
print(repr('\n\t\r\\\x00\x7f\x1b'), repr('é'), 'é'.upper(), len('é😀'), 'é😀'[1], 'aé'[::-1])
# ----
print("""triple
  lines 'quoted' "here" """, '''other
one''')
# ----
s = 'hello world'
print(s[0], s[-1], s[1:5], s[:5], s[6:], s[::2], s[::-1], s[-5:-2], s[10:2:-2], s[100:], s[:-100], s[5:2])
# ----
s = 'hello world'
print(len(s), s.upper(), s.capitalize(), s.title(), s.swapcase(), s.center(21, '*'), s.ljust(15) + '|', s.rjust(15), s.zfill(15))
# ----
print('ab'.center(5) + '|', 'abc'.center(6) + '|', 'a'.center(4, '-'), 'abcd'.center(7, '-'), '-5'.zfill(5), '+5'.zfill(4), 'x'.zfill(0))
# ----
print('a,b,,c'.split(','), ' a  b c '.split(), 'a,b,c'.split(',', 1), ''.split(), ''.split(','), ' a b '.split(' '), 'abc'.split('bc'))
# ----
print('a,b,,c'.rsplit(',', 1), ' a  b c '.rsplit(None, 1), 'a b c d'.rsplit(maxsplit=2), ' a  b c '.split(None, 1), 'x'.rsplit('x'))
# ----
print('a\nb\r\nc\rd'.splitlines(), 'a\nb\n'.splitlines(True), ''.splitlines(), '\n'.splitlines())
# ----
print(', '.join(['a', 'b']), ''.join('abc'), '-'.join(()), '-'.join(str(i) for i in range(5)))
# ----
print('aXbXc'.replace('X', '--'), 'aaa'.replace('a', 'b', 2), 'abc'.replace('', '.'), 'abc'.replace('z', 'y'), 'abc'.replace('', '-', 2), ''.replace('', 'x'))
# ----
print('hello'.find('l'), 'hello'.rfind('l'), 'hello'.find('z'), 'hello'.index('e'), 'hello'.find('l', 3), 'hello'.find('l', 0, 2), 'hello'.find('', 10), 'hello'.find('', 5), 'hello'.rfind(''))
# ----
print('banana'.count('a'), 'banana'.count('an'), 'aaaa'.count('aa'), 'abc'.count(''), 'banana'.count('a', 2), 'banana'.count('a', 2, 4))
# ----
print('hello'.startswith('he'), 'hello'.endswith('lo'), 'hello'.startswith(('x', 'h')), 'hello'.endswith(()), 'hello'.startswith('l', 2), 'hello'.startswith(''))
# ----
print('  x '.strip() + '|', '  x '.lstrip() + '|', '  x '.rstrip() + '|', 'xxaxx'.strip('x'), 'abcba'.strip('ab'), '\t\n x'.strip(), 'abc'.strip(''))
# ----
print('a=b=c'.partition('='), 'a=b=c'.rpartition('='), 'abc'.partition('='), 'abc'.rpartition('='))
# ----
print('123'.isdigit(), 'a1'.isalnum(), 'abc'.isalpha(), ' '.isspace(), ''.isdigit(), 'ABC'.isupper(), 'abc'.islower(), 'A1'.isupper(), '1'.islower(), 'a b'.isalpha(), 'a_b'.isidentifier(), '1a'.isidentifier())
# ----
print('TestCase'.removeprefix('Test'), 'TestCase'.removesuffix('Case'), 'abc'.removeprefix('x'), 'a\tb'.expandtabs(4), 'ab\tc\td'.expandtabs())
# ----
print('a' + 'b', 'ab' * 3, 3 * 'ab', 'ab' * 0, 'ab' * -1, 'a' in 'abc', 'bc' in 'abc', '' in 'abc', 'x' not in 'abc')
# ----
print('a' < 'b', 'a' < 'B', 'abc' < 'abd', 'ab' < 'abc', '' < 'a', 'Z' < 'a', 'é' > 'z', 'a' == 'a', 'a' != 'b', max('hello'), min('hello'), sorted('hello'))
# ----
print(ord('a'), chr(98), ord('é'), chr(233), chr(0x1F600), str(5), str(1.0), str(None), str(True), str([1, 'a']), str(('x',)), str({'a': 1}), repr('x'), ascii('é😀'))
# ----
for c in 'abé':
    print(c, end=';')
print()
print(list('abc'), tuple('ab'), set('a'), dict(zip('ab', (1, 2))), list(enumerate('ab')), list(reversed('abc')))
# ----
print('%d %5d %-5d| %05d %+d % d %x %X %o %#x %#o' % (42, 42, 42, 42, 42, 42, 255, 255, 8, 255, 8))
# ----
print('%f %.2f %10.3f %-10.3f| %+.1f %010.2f %e %.3e %E %g %G %.3g' % (3.14159, 3.14159, 3.14159, 3.14159, 3.14159, -3.14159, 31415.9, 31415.9, 31415.9, 31415.9, 1e-10, 31415.9))
# ----
print('%s %r %10s| %-10s| %.2s %%  %c %c' % ('a', 'a', 'a', 'a', 'abc', 'x', 65))
# ----
print('%(a)s %(b)05.1f %(a)r' % {'a': 'x', 'b': 2.5}, '%*d %-*d|' % (5, 42, 5, 42), '%.*f' % (2, 3.14159))
# ----
print('%s' % 5, '%s' % None, '%s' % [1, 2], '%s' % (1,), '%s %s' % ((1, 2), 3), '%d' % 3.99, '%d' % True, '%i' % -7, '%s' % {'a': 1}, '%5.1f%%' % 45.678)
# ----
print('%d' % 2**70, '%x' % 2**70, '%.3d' % 5, '%+.3d' % 5, '%8.3d|' % 5, '%e' % 0, '%g' % 0.0001, '%g' % 0.00001, '%g' % 1e6, '%g' % 123456789)
# ----
print('{} {}'.format(1, 'a'), '{0} {1} {0}'.format('x', 'y'), '{a} {b}'.format(a=1, b=2), '{{}} {}'.format(3), '{0[1]} {1[k]}'.format([1, 2], {'k': 'v'}), '{0.real}'.format(3 + 4j))
# ----
print('{:5}|{:<5}|{:>5}|{:^5}|{:*^7}|{:05}|{:+}|{: }|{:-}'.format(42, 42, 42, 42, 42, 42, 42, 42, 42))
# ----
print('{:5}|{:<5}|{:>5}|{:^5}|{:*^7}|{:.2}|{:5.1}|'.format('abc', 'abc', 'abc', 'abc', 'abc', 'abc', 'abc'))
# ----
print('{:f} {:.2f} {:10.3f} {:<10.3f}| {:+.1f} {:010.2f} {:e} {:.3E} {:g} {:.3g} {:%} {:.1%}'.format(3.14159, 3.14159, 3.14159, 3.14159, 3.14159, -3.14159, 31415.9, 31415.9, 31415.9, 31415.9, 0.256, 0.256))
# ----
print('{:d} {:x} {:X} {:o} {:b} {:#x} {:#b} {:#o} {:,} {:_} {:c} {:n}'.format(42, 255, 255, 8, 5, 255, 5, 8, 1234567, 1234567, 65, 42))
# ----
print('{:,.2f} {:_.1f} {:,} {:012,} {:012,.1f} {:,d}'.format(1234567.891, 1234567.891, 1234567.5, 1234567, 1234567.8, -1234567))
# ----
print('{:_x} {:_b} {:#_x} {:010_d}'.format(0xdeadbeef, 255, 0xdeadbeef, 1234567))
# ----
print('{!r} {!s} {!r:>8} {:{}} {:{w}.{p}f}'.format('a', 'b', 'c', 5, 6, 3.14159, w=8, p=2))
# ----
print(format(3.0), format(3.0, ''), format(3.14159, '.3'), format(1e10, '.3'), format(100.0, '.3'), format(1234.5, '.3'), format(0.0001, '.2'), format(1e-5, '.2'), format(123456.0, '.6'), format(1234567.0, '.7'))
# ----
print(format(True), format(True, 'd'), format(True, '5'), format(None), format(3, 'f'), format(3, '.2e'), format(2**70, ','), format(-5, '05'), format(-5, '=5'), format(-5, '^6'))
# ----
print(format(1+2j, '.2f'), format(3.5j), format(1.5+2j, '>12'), '{:.1f}'.format(2.25), '{:.0f}'.format(0.5), '{:.0f}'.format(1.5), '{:.0f}'.format(2.5))
# ----
print('{:e}'.format(12345), '{:#.0f}'.format(3.0), '{:#g}'.format(3.0), '{:g}'.format(1e20), '{:g}'.format(1e-20), '{:.10g}'.format(1/3), '{:.0e}'.format(15000.0), '{:.17g}'.format(0.1), '{:.20f}'.format(0.1))
# ----
print('{:f} {:F} {:g} {:5}'.format(float('inf'), float('nan'), float('-inf'), float('nan')), '%f %5.1f' % (float('inf'), float('nan')), '{:05}'.format(float('inf')))
# ----
x = 5; y = 'text'; z = 3.14159; d = {'k': 1}
print(f'{x} {y} {z:.2f} {x + 1} {y!r} {y:>6} {d["k"]} {{}} {x:{x}} {z:{x}.{2}f} {x!s:>3}')
# ----
x = 5; name = 'a'
print(f'{x=} {x = } {name=} {x=:>4} {name=!s} {x + 1=}')
# ----
x = [1, 2]
print(f'{x[0]} {x} {[i * 2 for i in x]} {(lambda a: a + 1)(3)} {"nested"} {x if x else 0} {len(x):03d}' f' second' ' third {x}')
# ----
print(f'''multi {1 +
2} line''', rf'raw\n {3}', fr"\t{4}", F'{5}')
# ----
print(f'{3!r:^7}|{"a" "b"}|{1,2}|{ {"a": 1}["a"] }|{True and "yes"}|{1 != 2}|{3 >= 2}')
# ----
print('a\\b', 'a\qb'.replace('\\', '/'), len('\\'), '\'', "\"", 'tab\there')
# ----
print('abc'.__class__.__name__ if False else type('abc').__name__, isinstance('a', str), 'A'.lower(), 'ß'.upper(), 'É'.lower(), 'éa'.title())
# ----
print("hello %s, you are %d years and %5.2f m" % ("Bob", 42, 1.756), "%s" % "a" + "b", "%s=%s;" * 2 % (1, 2, 3, 4))
# ----
print('{:>{}}'.format('a', 5), '{:{fill}{align}{width}}'.format('x', fill='*', align='^', width=5), '{0:{1}}|{0:<{1}}'.format('ab', 6))
# ----
print(str(1e15), str(1e16), str(123456789.123), str(-1.5e-10), str(1e0), str(12345678901234567.0), 1e-4, 1.0e-04, 100000000000000000000.0)
# ----
print("a".join(["1"]), "".join([]), str.upper('abc'), str.join(',', ['a', 'b']), list(map(str, [1, 2])), list(map(str.strip, [' a ', 'b '])))
# ----
print('line1', 'line2', sep='\n'); print('a', 'b', sep='', end='!\n'); print(); print('x', 1, None, 2.5, [1], sep=', ')
# ----
for field in ('%99999999999999999999d', '%.99999999999999999999f', '%.2147483647s'):
    try:
        print(field % (7,))
    except ValueError as error:
        print(error)
for code in (-1, 0x110000):
    try:
        print('%c' % code)
    except OverflowError as error:
        print(error)
# ----
print(f"N{5:>03}", f"{5:<03}|", f"{-5:^06}", f"{5:*>03}", "{:>04d}".format(5), format(2.5, ">08.2f"), f"{'ab':05}|", f"{'ab':>05}", f"{7:=+05}")
