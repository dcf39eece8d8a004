"""The weights of a checkpoint without the state of training: docs/formats.md."""
import json
import struct
import zlib

CHECKSUM = "wordgaze.crc32"
STATE = ("adam.", "train.", "lanes.")


def weights_only(checkpoint):
    """The bytes of such a file, from the bytes of a checkpoint."""
    length, = struct.unpack("<Q", checkpoint[:8])
    header, numbers = json.loads(checkpoint[8:8 + length]), checkpoint[8 + length:]
    kept, parts, end = {"__metadata__": header.pop("__metadata__") | {CHECKSUM: "00000000"}}, [], 0
    for name, tensor in sorted(header.items(), key=lambda item: item[1]["data_offsets"]):
        if name.startswith(STATE):
            continue
        begin, stop = tensor["data_offsets"]
        parts.append(numbers[begin:stop])
        kept[name] = tensor | {"data_offsets": [end, end + stop - begin]}
        end += stop - begin
    text = json.dumps(kept, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 8)
    whole = struct.pack("<Q", len(text)) + text + b"".join(parts)
    zeros = f'"{CHECKSUM}":"00000000"'.encode()
    return whole.replace(zeros, f'"{CHECKSUM}":"{zlib.crc32(whole):08x}"'.encode(), 1)
