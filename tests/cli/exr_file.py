"""Reads the OpenEXR files that bihive writes: scan lines, ZIP or none, 32-bit numbers. Written from the format's description
alone, so that it shares no code with the writer."""

import struct
import zlib

TYPES = {0: "I", 1: "e", 2: "f"}


class ExrFile:
    """attributes: name -> (type, bytes). channels: name -> rows of numbers. x, y: of the first pixel."""

    def __init__(self, data):
        assert data[:4] == b"\x76\x2f\x31\x01", "no OpenEXR"
        assert struct.unpack("<I", data[4:8])[0] & 0xFF == 2
        self.data, self.at = data, 8
        self.attributes = {}
        while name := self.text():
            kind, size = self.text(), self.numbers("<i")[0]
            self.attributes[name] = (kind, self.data[self.at : self.at + size])
            self.at += size
        self.x, self.y, last_x, last_y = self.box("dataWindow")
        self.width, self.height = last_x - self.x + 1, last_y - self.y + 1
        self.types = dict(self.channel_list())
        self.channels = {name: [] for name in self.types}
        lines = {0: 1, 2: 1, 3: 16}[self.attributes["compression"][1][0]]
        places = self.numbers(f"<{(self.height + lines - 1) // lines}Q")
        for number, place in enumerate(places):
            self.block(place, self.y + number * lines, min(lines, self.height - number * lines))

    def text(self):
        end = self.data.index(b"\0", self.at)
        found, self.at = self.data[self.at : end].decode(), end + 1
        return found

    def numbers(self, form):
        found = struct.unpack_from(form, self.data, self.at)
        self.at += struct.calcsize(form)
        return found

    def box(self, name):
        return struct.unpack("<4i", self.attributes[name][1])

    def channel_list(self):
        body, at = self.attributes["channels"][1], 0
        while body[at]:
            end = body.index(b"\0", at)
            yield body[at:end].decode(), TYPES[struct.unpack_from("<i", body, end + 1)[0]]
            at = end + 17

    def block(self, place, first_y, lines):
        y, size = struct.unpack_from("<ii", self.data, place)
        assert y == first_y, (y, first_y)
        line = sum(struct.calcsize(kind) for kind in self.types.values()) * self.width
        packed = self.data[place + 8 : place + 8 + size]
        raw = packed if size == line * lines else unzipped(packed)
        assert len(raw) == line * lines
        at = 0
        for _ in range(lines):
            for name, kind in self.types.items():
                form = f"<{self.width}{kind}"
                self.channels[name].append(list(struct.unpack_from(form, raw, at)))
                at += struct.calcsize(form)


def unzipped(packed):
    """The bytes before ZIP compression: differences are summed, then the two halves interleaved."""
    summed = bytearray(zlib.decompress(packed))
    for i in range(1, len(summed)):
        summed[i] = (summed[i - 1] + summed[i] - 128) & 255
    half = (len(summed) + 1) // 2
    raw = bytearray(len(summed))
    raw[::2], raw[1::2] = summed[:half], summed[half:]
    return bytes(raw)
