"""Change arguments of recorded calls, so that a trace differs from the program's calls in known places.

The grammar is in capture/format/trace.md. Numbers and bytes are overwritten in place. No call is added or removed, so
call numbers do not change.
"""
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fuzz"))
from mutate import pack, uint, unpack  # noqa: E402


def put_uint(value):
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    out.append(value)
    return bytes(out)


class Value:
    """A value and the range of its changeable bytes: [start, end)."""

    def __init__(self, kind, value, start, end):
        self.kind, self.value, self.start, self.end = kind, value, start, end


class Trace:
    def __init__(self, path):
        self.data = bytes(unpack(pathlib.Path(path).read_bytes()))
        self.patches, self.calls, self.known = [], [], {"call": {}, "enum": set(), "mask": set(), "struct": {}}
        self._read()

    def save(self, path):
        out, at = bytearray(), 0
        for start, end, new in sorted(self.patches):
            out += self.data[at:start] + new
            at = end
        pathlib.Path(path).write_bytes(pack(bytes(out + self.data[at:])))

    def change(self, value, new):
        """Overwrite a value with another number or other bytes."""
        if value.kind == "float":
            new = struct.pack("<f", new)
        elif value.kind == "double":
            new = struct.pack("<d", new)
        elif value.kind == "number":
            new = (b"\3" if new < 0 else b"\4") + put_uint(abs(new))
        else:
            assert value.kind == "blob" and len(new) == value.end - value.start
        self.patches.append((value.start, value.end, bytes(new)))

    def find(self, name):
        found = [args for other, args in self.calls if other == name]
        assert found, f"the trace has no call of {name}"
        return found

    # reading

    def _text(self, at):
        n, at = uint(self.data, at)
        return self.data[at:at + n].decode(errors="replace"), at + n

    def _number(self, at):
        value, end = uint(self.data, at + 1)
        return Value("number", -value if self.data[at] == 3 else value, at, end), end

    def _value(self, at):
        tag, start = self.data[at], at
        at += 1
        if tag <= 2:
            return Value("other", (None, False, True)[tag], start, at), at
        if tag in (3, 4):
            return self._number(start)
        if tag == 5:
            return Value("float", struct.unpack_from("<f", self.data, at)[0], at, at + 4), at + 4
        if tag == 6:
            return Value("double", struct.unpack_from("<d", self.data, at)[0], at, at + 8), at + 8
        if tag == 7:
            text, at = self._text(at)
            return Value("other", text, start, at), at
        if tag == 8:
            n, at = uint(self.data, at)
            return Value("blob", self.data[at:at + n], at, at + n), at + n
        if tag in (9, 10):
            kind = self.known["enum" if tag == 9 else "mask"]
            number, at = uint(self.data, at)
            if number not in kind:
                kind.add(number)
                n, at = uint(self.data, at)
                for _ in range(n):
                    _, at = self._text(at)
                    at = self._number(at)[1] if tag == 9 else uint(self.data, at)[1]
            if tag == 9:
                return self._number(at)
            value, end = uint(self.data, at)
            return Value("other", value, at, end), end
        if tag == 11:
            n, at = uint(self.data, at)
            items = []
            for _ in range(n):
                item, at = self._value(at)
                items.append(item)
            return Value("array", items, start, at), at
        if tag == 12:
            number, at = uint(self.data, at)
            if number not in self.known["struct"]:
                _, at = self._text(at)
                n, at = uint(self.data, at)
                self.known["struct"][number] = n
                for _ in range(n):
                    _, at = self._text(at)
            for _ in range(self.known["struct"][number]):
                _, at = self._value(at)
            return Value("other", None, start, at), at
        assert tag == 13, f"tag {tag} at {start}"
        value, at = uint(self.data, at)
        return Value("other", value, start, at), at

    def _details(self, at, args):
        while self.data[at]:
            kind = self.data[at]
            at += 1
            if kind == 1:
                index, at = uint(self.data, at)
                args[index], at = self._value(at)
            elif kind == 2:
                _, at = self._value(at)
            else:
                assert kind == 5
                _, at = uint(self.data, at)
        return at + 1

    def _read(self):
        assert self.data[:2] == b"\6\6"
        at = 2
        while self.data[at]:  # properties end with an empty key
            _, at = self._text(at)
            _, at = self._text(at)
        at += 1
        while at < len(self.data):
            kind = self.data[at]
            first, at = uint(self.data, at + 1)  # a thread number, or the number of the call that returns
            if kind == 1:
                at = self._details(at, {})
                continue
            number, at = uint(self.data, at)
            if number not in self.known["call"]:
                self.known["call"][number], at = self._text(at)
                n, at = uint(self.data, at)
                for _ in range(n):
                    _, at = self._text(at)
            args = {}
            at = self._details(at, args)
            self.calls.append((self.known["call"][number], args))
