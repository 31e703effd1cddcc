"""Damages files at random, for scripts/fuzz: trees of YAML, texts, bytes, LCM logs and tables."""

import copy
import struct

import yaml

# What a number, a word or a key may become.
EXTREMES = [0, -0.0, 1, -1, 2, 1e-320, 1e-300, 1e-30, 1e-9, 1e-3, 0.3, 1e3, 1e6, 1e9, 1e15, 1e18, 9.3e18, 1e30, 1e300,
            1.7e308, -1e300, 4, 100, 1000, 100000, 1000000, 2**31, 2**63, -(2**31)]
STRANGE = [float("nan"), float("inf"), float("-inf"), "1e999", "", "~", None, True, [], {}, [1], {"a": 1}, "x" * 300,
           "x\x1b[2J\x1b[31m", "é\u202e", "auto", "1.0.0", "0x10", "1,5", "\n", "- a"]
CELLS = ["nan", "inf", "-inf", "1e999", "1e308", "-1e308", "1e-320", "-0.0", "", " ", '"', '"1"', "0x1p3", "1,2", "1;2", "x",
         "1e18", "-8e9", "4e9", "1e12", "\r", "\0", "\ufeff", "9" * 400, "--1", "+", ".", "1.0.0"]
# Big-endian, as logs have them: of 64 bits.
DOUBLES = [struct.pack(">d", x) for x in (float("nan"), float("inf"), float("-inf"), 0.0, -0.0, 1.0, -1.0, 5e-324, 1e-300,
                                          1e-9, 1e9, 1e15, 1e18, 1e19, 1e300, -1e300, 1.7e308)]
WHOLES = [struct.pack(">q", n) for n in (0, 1, -1, 2, 60, 1000, 50000, 10**6, 10**9, 3600 * 10**9, 10**18, 4294967295 * 10**9,
                                         2**63 - 1, -2**63)]
SYNC = b"\xed\xa1\xda\x01"
HEADER = ">4sqqii"  # of an event: sync word, number, stamp [us], lengths of channel and payload


class Damage:
    """Changes to files, with one source of chance."""

    def __init__(self, rng):
        self.rng = rng

    def places(self, tree, found=None):
        found = [] if found is None else found
        items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else []
        for key, value in items:
            found.append((tree, key))
            self.places(value, found)
        return found

    def of_tree(self, tree, other):
        tree = copy.deepcopy(tree)
        for _ in range(self.rng.choice([1, 1, 1, 2, 4])):  # most that is damaged twice is refused
            places = self.places(tree)
            if not places:
                break
            numbers = [(h, k) for h, k in places if isinstance(h[k], (int, float))]
            what = self.rng.random()
            holder, key = self.rng.choice(numbers if what < 0.7 and numbers else places)
            if what < 0.7 and numbers:
                value = holder[key]
                holder[key] = self.rng.choice(
                    [self.rng.choice(EXTREMES), value * 10.0 ** self.rng.randint(-12, 12), -value, value + 1])
            elif what < 0.75:
                holder[key] = self.rng.choice(STRANGE + EXTREMES)
            elif what < 0.8:
                del holder[key]
            elif what < 0.86 and isinstance(holder, dict):
                name = str(key)
                at = self.rng.randint(0, len(name))
                holder[name[:at] + self.rng.choice("abxyz_ 1") + name[at:]] = holder.pop(key)
            elif what < 0.93:
                twin, place = self.rng.choice(self.places(other))
                holder[key] = copy.deepcopy(twin[place])
            elif isinstance(holder, list):
                holder.append(copy.deepcopy(holder[key]))
            else:
                holder[self.rng.choice(["substeps", "count", "integrator", "horizon", "tolerance", "modes"])] = \
                    self.rng.choice(EXTREMES + STRANGE)
        return tree

    def of_text(self, text):
        text = list(text)
        for _ in range(self.rng.choice([1, 1, 1, 2, 4])):  # most that is damaged twice is refused
            at = self.rng.randrange(len(text) + 1)
            length = self.rng.randint(1, 20)
            what = self.rng.randrange(4)
            if what == 0:
                del text[at:at + length]
            elif what == 1:
                text[at:at] = text[at:at + length]
            elif what == 2:
                text[at:at] = list(str(self.rng.choice(EXTREMES + STRANGE)))
            else:
                text[at:at + 1] = [chr(self.rng.choice([0, 9, 10, 27, 34, 38, 42, 58, 91, 123, 233, 0x202E]))]
        return "".join(text)

    def of_bytes(self, data):
        data = bytearray(data)
        for _ in range(self.rng.randint(1, 6)):
            at = self.rng.randrange(len(data))
            what = self.rng.randrange(4)
            if what == 0:
                data[at] ^= 1 << self.rng.randrange(8)
            elif what == 1:
                del data[at:at + self.rng.randint(1, 400)]
            elif what == 2:
                data[at:at + 8] = self.rng.choice([b"\x7f\xf0" + bytes(6), b"\xff" * 8, b"\x80" + bytes(7), bytes(8),
                                                   b"\x7f" + b"\xff" * 7, b"\x7e\x37\xe4\x3c\x88\x00\x75\x9c"])
            else:
                data[at:at] = data[at:at + self.rng.randint(1, 400)]
        return bytes(data)

    def yaml(self, tree, other):
        """A file of YAML, damaged as a tree, as a text, or both."""
        what = self.rng.random()
        text = yaml.safe_dump(self.of_tree(tree, other) if what < 0.8 else tree, allow_unicode=True, width=1000)
        return text if what < 0.7 else self.of_text(text)

    def of_log(self, data):
        """A log whose events stay events: other stamps, channels and order, numbers changed, events lost and doubled."""
        events, at = [], 0
        size = struct.calcsize(HEADER)
        while at + size <= len(data):
            _, number, stamp, channel, payload = struct.unpack_from(HEADER, data, at)
            at += size
            events.append([number, stamp, data[at:at + channel], bytearray(data[at + channel:at + channel + payload])])
            at += channel + payload
        for _ in range(self.rng.choice([1, 1, 2, 5, 40])):
            i = self.rng.randrange(len(events))
            number, stamp, channel, payload = events[i]
            what = self.rng.random()
            if what < 0.6 and len(payload) >= 16:
                # Most fields have 8 bytes, but texts before them may have shifted them by any number.
                place = self.rng.randrange(8, len(payload) - 7)
                payload[place:place + 8] = self.rng.choice(DOUBLES + WHOLES)
            elif what < 0.7:
                events[i][1] = self.rng.choice([0, -1, stamp // 2 + 10**9, stamp // 2, 2**62, -2**63, 2**63 - 1])
            elif what < 0.75:
                events[i][2] = self.rng.choice(events)[2]
            elif what < 0.8:
                del events[i:i + self.rng.choice([1, 1, 10, 1000])]
                if not events:
                    break
            elif what < 0.85:
                events.insert(self.rng.randrange(len(events)), [number, stamp, channel, bytearray(payload)])
            elif what < 0.9:
                other = self.rng.randrange(len(events))
                events[i], events[other] = events[other], events[i]
            elif what < 0.95:
                del payload[self.rng.randrange(len(payload) + 1):]
            else:
                events.reverse()
        return b"".join(struct.pack(HEADER, SYNC, number, stamp, len(channel), len(payload)) + channel + payload
                        for number, stamp, channel, payload in events)

    def of_table(self, text):
        """Comma-separated values: cells, rows and columns changed, or the text itself."""
        rows = [line.split(",") for line in text.splitlines()]
        for _ in range(self.rng.choice([1, 1, 2, 4, 20])):
            i = self.rng.randrange(len(rows))
            what = self.rng.random()
            if what < 0.6 and rows[i]:
                place = self.rng.randrange(len(rows[i]))
                rows[i][place] = self.rng.choice(CELLS + [str(x) for x in EXTREMES])
            elif what < 0.7:
                rows.insert(self.rng.randrange(len(rows)), list(rows[i]))
            elif what < 0.8:
                del rows[i]
                if not rows:
                    break
            elif what < 0.85:
                rows[i].append(self.rng.choice(CELLS))
            elif what < 0.9:
                column = self.rng.randrange(3)
                value = self.rng.choice(CELLS)
                rows[1:] = [row[:column] + [value] + row[column + 1:] for row in rows[1:]]
            elif what < 0.95:
                rows[1:] = reversed(rows[1:])
            else:
                del rows[i:]
                if not rows:
                    break
        text = "\n".join(",".join(row) for row in rows) + "\n"
        return text if self.rng.random() < 0.85 else self.of_text(text)

    def of_yaml_text(self, text):
        """What YAML can do to its reader: nesting, anchors that multiply or turn in circles, merges, keys without end."""
        depth = self.rng.choice([3, 30, 300, 3000, 30000])
        lines = text.splitlines()
        at = self.rng.randrange(len(lines) + 1)
        indent = " " * (len(lines[at]) - len(lines[at].lstrip())) if at < len(lines) else ""
        what = self.rng.randrange(9)
        if what == 0:
            added = [indent + "x: " + "[" * depth + "]" * self.rng.choice([0, depth])]
        elif what == 1:
            added = [indent + "x: " + "{a: " * depth + "1" + "}" * self.rng.choice([0, depth])]
        elif what == 2:
            added = [indent + "- " * depth + "1"]
        elif what == 3:  # billion laughs
            added = ["a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]"] + [
                f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, min(depth, 30))]
            lines, at = added + [line.replace(": 1", f": *a{len(added) - 1}") for line in lines], 0
            added = []
        elif what == 4:
            added = [f"{indent}{self.rng.choice(['initial', 'parameters', 'x', '<<'])}: &x {{<<: *x, a: *x}}"]
        elif what == 5:
            added = [f"{indent}k{i}: {{model: pendulum}}" for i in range(min(depth, 3000))]
        elif what == 6:
            added = [indent + "list: [" + ", ".join(["1e300"] * depth) + "]"]
        elif what == 7:
            added = [indent + "? " * min(depth, 300) + "a"]
        else:
            added = [indent + self.rng.choice(["%YAML 9.9", "---", "...", "!!python/object:os.system x", "!!binary abc",
                                               "\ufeff", "&a", "*a", "<<: 1", "? [a]: b", "a: |", "\t- b", "\x85", "\x00"])]
        return "\n".join(lines[:at] + added + lines[at:]) + "\n"
