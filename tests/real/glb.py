"""A strict reader of binary glTF 2.0: any violation of the specification raises ValueError.

Covers the rules in the specification (Khronos, 2.0.1, sections 3 to 5) that Relume's files could break.
"""
import json
import math
import struct

COMPONENTS = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}
TYPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def need(good, what):
    if not good:
        raise ValueError(what)


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        magic, version, length = struct.unpack_from("<4sII", data)
        need(magic == b"glTF" and version == 2 and length == len(data), "header (4.4.2)")
        n, kind = struct.unpack_from("<I4s", data, 12)
        need(kind == b"JSON" and n % 4 == 0, "first chunk (4.4.3)")
        self.json = json.loads(data[20:20 + n])
        m, kind = struct.unpack_from("<I4s", data, 20 + n)
        need(kind == b"BIN\0" and m % 4 == 0 and 28 + n + m == len(data), "second chunk (4.4.3)")
        self.bin = data[28 + n:]
        need(0 <= len(self.bin) - self.json["buffers"][0]["byteLength"] <= 3, "buffer length (4.4.3.3)")
        self._check_names()
        self._check_accessors()
        self._check_nodes()

    def _check_names(self):
        used = set(self.json.get("extensionsUsed", []))
        found = set()

        def walk(item):
            if isinstance(item, dict):
                found.update(item.get("extensions", {}))
                for value in item.values():
                    need(value != [], "empty array (5.17)")
                    walk(value)
            elif isinstance(item, list):
                for value in item:
                    walk(value)
        walk(self.json)
        need(found == used, f"extensions used {found} , declared {used} (3.12)")

    def _check_accessors(self):
        for view in self.json["bufferViews"]:
            need(view["byteOffset"] + view["byteLength"] <= self.json["buffers"][0]["byteLength"],
                 "bufferView's end (5.11)")
        for i, accessor in enumerate(self.json["accessors"]):
            values = self.values(i)
            need(all(math.isfinite(v) for row in values for v in row), "not a number (3.6.2.2)")
            for name, pick in (("min", min), ("max", max)):
                if name in accessor:
                    need(
                        accessor[name] == [shorter(pick(row[k] for row in values)) for k in range(len(accessor[name]))],
                        f"{name} of accessor {i} (3.6.2.5)")
        for mesh in self.json["meshes"]:
            for primitive in mesh["primitives"]:
                attributes = primitive["attributes"]
                n = {self.json["accessors"][a]["count"] for a in attributes.values()}
                need(len(n) == 1, "attributes of one length (3.7.2.1)")
                need("max" in self.json["accessors"][attributes["POSITION"]], "bounds of positions (3.7.2.1)")
                need(max(self.values(primitive["indices"]))[0] < min(n), "index in range (3.7.2.1)")
                for normal in self.values(attributes["NORMAL"]) if "NORMAL" in attributes else ():
                    need(abs(math.hypot(*normal) - 1) < 1e-3, "normals of length 1 (3.7.2.1)")
                need(primitive["material"] < len(self.json["materials"]), "material (5.24)")

    def _check_nodes(self):
        nodes = self.json["nodes"]
        owned = [n for scene in self.json["scenes"] for n in scene["nodes"]]
        need(sorted(owned) == list(range(len(nodes))), "each node in one scene (3.5)")
        for node in nodes:
            m = node.get("matrix")
            if not m:
                continue
            columns = [m[4 * i:4 * i + 3] for i in range(3)]
            need(m[3] == m[7] == m[11] == 0 and m[15] == 1, "affine matrix (3.5.3)")
            for i in range(3):
                a, b = columns[i], columns[(i + 1) % 3]
                product = sum(x * y for x, y in zip(a, b))
                need(abs(product) <= 1e-3 * math.hypot(*a) * math.hypot(*b) > 0, "matrix that decomposes (3.5.3)")

    def values(self, accessor):
        """All elements of an accessor, as tuples."""
        a = self.json["accessors"][accessor]
        view = self.json["bufferViews"][a["bufferView"]]
        letter, size = COMPONENTS[a["componentType"]]
        width = TYPES[a["type"]]
        need(a["count"] * width * size <= view["byteLength"] and view["byteOffset"] % size == 0,
             "accessor in its view (3.6.2)")
        return list(
            struct.iter_unpack(f"<{width}{letter}",
                               self.bin[view["byteOffset"]:view["byteOffset"] + a["count"] * width * size]))

    def triangles_eye(self):
        """Corners of all triangles in scene space, by node name."""
        found = {}
        for node in self.json["nodes"]:
            if "mesh" not in node:
                continue
            m = node.get("matrix", [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
            primitive = self.json["meshes"][node["mesh"]]["primitives"][0]
            if primitive["mode"] != 4:
                continue
            points = self.values(primitive["attributes"]["POSITION"])
            moved = [tuple(sum(m[4 * k + i] * p[k] for k in range(3)) + m[12 + i] for i in range(3)) for p in points]
            found.setdefault(node["name"], []).extend(moved[i] for (i,) in self.values(primitive["indices"]))
        return found


def shorter(value):
    """A float rounded to nine digits, as in JSON."""
    return float(f"{value:.9g}")
