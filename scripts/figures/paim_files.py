# Reads the sections of .bake and .paim files, as docs/format.md describes them.
# Standard library only, and libzstd for compressed sections. Checksums are not checked:
# `paim-info FILE` does that.
import array
import ctypes
import ctypes.util
import json
import struct
from pathlib import Path

_TYPES = {0: "B", 1: "I", 2: "e", 3: "f", 4: "d", 5: "b", 6: "h"}


def _decompress(data, size):
    zstd = ctypes.CDLL(ctypes.util.find_library("zstd"))
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    out = ctypes.create_string_buffer(size)
    written = zstd.ZSTD_decompress(out, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data)))
    if written != size:
        raise ValueError("damaged Zstandard frame")
    return out.raw


class Container:
    """One file: `self[tag]` or `self[tag, index]` are the values of a section, row by row."""

    def __init__(self, path):
        self._data = Path(path).read_bytes()
        if self._data[:8] != b"\x89PAIM\r\n\x1a":
            raise ValueError(f"{path}: not a file of Paim's")
        (num_sections,) = struct.unpack_from("<I", self._data, 24)
        self.sections = {}
        for entry in range(num_sections):
            place = 64 + 64 * entry
            tag = self._data[place : place + 4].decode()
            scalar, codec, _, index = struct.unpack_from("<BBHI", self._data, place + 4)
            shape = struct.unpack_from("<3I", self._data, place + 12)
            offset, stored, raw = struct.unpack_from("<3Q", self._data, place + 32)
            self.sections[tag, index] = (scalar, codec, shape, offset, stored, raw)

    def __getitem__(self, key):
        key = key if isinstance(key, tuple) else (key, 0)
        scalar, codec, _, offset, stored, raw = self.sections[key]
        if codec > 1:
            raise ValueError(f"{key}: codec {codec} cannot be read here")
        data = self._data[offset : offset + stored]
        if codec == 1:
            data = _decompress(data, raw)
        if scalar == 2:
            return array.array("f", struct.unpack(f"<{len(data) // 2}e", data))
        return array.array(_TYPES[scalar], data)

    def meta(self):
        return json.loads(bytes(self["META"]))


class Bake:
    """A .bake directory."""

    def __init__(self, path):
        self.path = Path(path)
        self.manifest = json.loads((self.path / "manifest.json").read_text())
        self.num_vertices = self.manifest["num_vertices"]
        self.num_poses = len(self.manifest["poses"])

    def pose(self, p):
        return Container(self.path / f"pose_{p:06d}.bin")

    def mesh(self):
        return Container(self.path / "mesh.bin")

    def rows(self, tag):
        """[rows][P]: the data matrix of TRNF, NOIS or POSN; row = plane · V + vertex."""
        return list(zip(*(self.pose(p)[tag] for p in range(self.num_poses))))
