"""PNG files with 8 bits for each of red, green, and blue."""
import struct
import zlib


def as_png(width, height, color):
    """color: a function of the column and the row, from the top."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in color(x, y)) for y in range(height))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_png(name):
    """Returns the width, the height, and rows of colors."""
    with open(name, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, body = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, depth, colors = struct.unpack_from(">IIBB", data, at + 8)
            assert (depth, colors) == (8, 2)
        elif kind == b"IDAT":
            body += data[at + 8:at + 8 + size]
        at += 12 + size
    body = zlib.decompress(body)
    length, above, rows = 3 * width, [0] * (3 * width), []
    for y in range(height):
        kind, row = body[y * (length + 1)], list(body[y * (length + 1) + 1:(y + 1) * (length + 1)])
        for i in range(length):
            left, up, corner = row[i - 3] if i >= 3 else 0, above[i], above[i - 3] if i >= 3 else 0
            if kind == 1:
                predicted = left
            elif kind == 2:
                predicted = up
            elif kind == 3:
                predicted = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                predicted = min((left, up, corner), key=lambda c: abs(p - c))
            else:
                predicted = 0
            row[i] = (row[i] + predicted) & 255
        rows.append([tuple(row[3 * x:3 * x + 3]) for x in range(width)])
        above = row
    return width, height, rows
