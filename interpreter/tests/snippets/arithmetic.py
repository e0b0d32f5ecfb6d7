print(1 + 2, 7 // 2, -7 // 2, 7 // -2, -7 // -2, 7 % 3, -7 % 3, 7 % -3, -7 % -3)
# ----
print(7 / 2, 6 / 3, 1 / 3, -1 / 3, 10**20 / 3, 2**70 / 2**69)
# ----
print(2**10, 2**-1, (-2)**3, -2**2, 2**3**2, (-8)**(1/3))
# ----
print(2**100, -2**100, 3**200, 10**30 // 7, -10**30 // 7, 10**30 % 7, -10**30 % 7, 10**30 % -7)
# ----
print(9223372036854775807 + 1, -9223372036854775808 - 1, 9223372036854775807 * 3, -(-9223372036854775808))
# ----
print(4611686018427387904 * 2, 3037000500 * 3037000500, 9223372036854775807 - -1)
# ----
print(1.5 + 2, 1.5 * 2, 1.5 - 2, 1.5 / 2, 7.5 // 2, -7.5 // 2, 7.5 % 2, -7.5 % 2, 7.5 % -2)
# ----
print(1e308 * 10, -1e308 * 10, 1e-320, 5e-324, 1e16, 1e15, 123456789012345678.0)
# ----
print(0.1 + 0.2, 1.0, 100.0, 1e5, 1e22, 1e23, 0.0001, 0.00001, 1.5e-7, -0.0, 0.0)
# ----
print(True + True, True * 3, -True, +False, ~5, ~-1, not 0, not [])
# ----
print(5 & 3, 5 | 3, 5 ^ 3, 1 << 10, 1 << 70, -1 >> 3, 2**70 >> 60, -5 & 0xFF, -2**70 | 1, 2**70 ^ -1)
# ----
print(True & False, True | False, True ^ True, True & 1, 6 & True)
# ----
print(0x1F, 0o17, 0b101, 1_000_000, 0xDEAD_BEEF, 1e1_0, 00, 0_0)
# ----
print(3j, 1 + 2j, (1 + 2j) * (3 - 1j), (1 + 2j) / (3 - 1j), (1 + 2j)**2, abs(3 + 4j), 2j**2, (1+1j)**0.5)
# ----
print(1j * 1j, -1j, 1.5j, complex(1, -2), complex(0, 0), (1+2j).real, (1+2j).imag, (1+2j).conjugate())
# ----
print(10**400 // 10**399, 10**400 % 10**398 == 0, (10**400 + 1) % 10**200)
# ----
print(int(1e20), int(-1e20), int(2.9), int(-2.9), float(10**22), float(2**53 + 1))
# ----
print(divmod(7, 2), divmod(-7, 2), divmod(7.5, 2), divmod(-10**30, 7), divmod(7, -2.5))
# ----
print(round(2.5), round(3.5), round(-2.5), round(0.5), round(1.5), round(2.675, 2), round(1234.5678, -2), round(1234, -2), round(1250, -2), round(1350, -2))
# ----
print(round(1e20), round(2.5, 0), round(-0.4), round(1.23456789, 4), round(5), round(True), round(0.15, 1), round(2.345, 2))
# ----
print(pow(2, 10), pow(2, -1), pow(2, 10, 1000), pow(3, 200, 10**9 + 7), pow(2.0, 3), pow(7, 0, 1))
# ----
print(abs(-5), abs(5.5), abs(-0.0), abs(True), abs(-10**30))
# ----
print(1 < 2 < 3, 1 < 3 < 2, 1 == 1.0 == True, 2**53 == 2.0**53, 2**53 + 1 == 2.0**53, 2**53 + 1 > 2.0**53, 10**400 > 1e308)
# ----
print(3 > 2.5, 0.1 + 0.2 == 0.3, float('nan') == float('nan'), float('inf') > 10**400, 1 != 1.0)
# ----
print(hex(255), oct(8), bin(5), hex(-255), hex(2**70), bin(-5), int('ff', 16), int('0x1f', 0), int('-0b101', 2), int('z', 36), int(' 12 '), int('1_000'))
# ----
print(float('1.5'), float(' 1e3 '), float('-inf'), float('nan'), float('1_0.5'), float('.5'), float('5.'), float('+3'))
# ----
print(5 if 1 else 6, (lambda x: x * 2)(4), [1, 2][0], 3 .real, 2.5.is_integer(), (4.0).is_integer())
# ----
print((5).bit_length(), (2**70).bit_length(), (-5).bit_length(), (0).bit_length())
# ----
print(sum([1, 2, 3]), sum([0.1] * 10), sum([], 5), sum([[1], [2]], []), max(1, 2.5), min(3, 1, 2), max([1, 5, 3]), min('b', 'a'))
# ----
x = 5
x += 2; x *= 3; x -= 1; x /= 4; print(x)
# ----
x = 17
x //= 5; print(x); x **= 3; print(x); x %= 5; print(x); x <<= 4; print(x); x >>= 1; print(x); x |= 7; print(x); x &= 5; print(x); x ^= 1; print(x)
# ----
print(1e100, 1.7976931348623157e308, 2.2250738585072014e-308, 123456.789, 1/7, 100/3, 1e-5, 12345678901234567890.0)
# ----
print(-5 // 3, -5 % 3, 5 // -3, 5 % -3, -6 // 3, 0 // 5, 0 % 5, -0.0 // 1, 5.0 // -0.3, 1e300 % 3.7)
# ----
print(3.0 == 3, hash(3.0) == hash(3), hash(2**70) == hash(float(2**70)), {1: 'a', 1.0: 'b', True: 'c'})
# ----
print(1 or 2, 0 or 2, 1 and 2, 0 and 2, None or 'x', '' or [] or {}, not 1 == 2)
# ----
for a in (7, -7, 7.5, -7.5):
    for b in (2, -2, 2.5, -2.5):
        print(a, b, a // b, a % b, a / b, a * b, a - b)
# ----
x = 2**20000
print(x % 1000007, x.bit_length(), hex(x)[:10], len(hex(x)), oct(2**100), bin(2**65), len('%x' % x))
try: print(len(str(x)))
except ValueError as e: print('too long')
print(len(str(10**4200)), str(3**500)[-20:], '%d' % 10**30, f'{-2**80:,}')
# ----
import math
print(math.gcd(2**200, 6**100) == 2**100, math.isqrt(10**61), math.lcm(10**20, 15**15), math.comb(200, 100), math.factorial(100) // math.factorial(98))
