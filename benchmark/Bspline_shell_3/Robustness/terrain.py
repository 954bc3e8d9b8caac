#!/usr/bin/env python3
"""Writes a terrain: hills over the unit square, whose vertices are moved at random, also on the border.

   terrain.py FILE [SQUARES]           (OFF, triangles; default 100 squares on each side)
"""
import math
import random
import sys


def main():
    name, n = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 100
    random.seed(1)
    with open(name, "w", encoding="ascii") as file:
        file.write(f"OFF\n{(n + 1) ** 2} {2 * n * n} 0\n")
        for i in range(n + 1):
            for j in range(n + 1):
                x, y = i / n, j / n
                z = 0.06 * math.sin(5 * x) * math.cos(4 * y) + 0.02 * math.sin(17 * x + 3 * y)
                noise = [random.uniform(-0.1, 0.1) / n for _ in range(3)]
                file.write("%.17g %.17g %.17g\n" % (x + noise[0], y + noise[1], z + noise[2]))
        for i in range(n):
            for j in range(n):
                a, b = i * (n + 1) + j, (i + 1) * (n + 1) + j
                file.write(f"3 {a} {b} {b + 1}\n3 {a} {b + 1} {a + 1}\n")


if __name__ == "__main__":
    main()
