"""What a program asks for, block by block: a small reader of Fanuc, Sinumerik and LinuxCNC words. It knows no machine; what it does not
know it refuses (Unread), so that nothing is compared with a guess. Lengths in mm, angles in degrees, feeds in mm/min or deg/min."""

import re
from dataclasses import dataclass, field

import planes

LINEAR, ROTARY = "XYZ", "ABC"
WORD = re.compile(r"([A-Z]{2,}\d*|[A-Z]\d+(?==)|[A-Z])\s*=?\s*((?:IC|AC|DC)\()?\s*([+-]?(?:\d+\.?\d*|\.\d+))?(?:\))?")
OFFSETS = {"G54", "G55", "G56", "G57", "G58", "G59"}


class Unread(Exception):
    """A word that this reader does not know."""


@dataclass
class Motion:
    """One motion. `words` holds what the block names: value and whether it is an increment, offsets not yet added."""

    line: int
    kind: str  # rapid, linear, cw, ccw
    words: dict
    tcp: bool
    length: float
    shift: dict  # what a word means at zero, per axis: mm in machine coordinates, or degrees
    feed: float | None
    feed_mode: str = "G94"
    machine_frame: bool = False
    vector: tuple | None = None
    plane: str = "G17"
    arc: dict = field(default_factory=dict)
    speed: float | None = None
    inch: bool = False
    great_circle: bool | None = None
    tilt: tuple | None = None  # the tilted plane in which X Y Z are told, in the frame of the offset
    swivel: bool = False  # only the rotary axes turn, onto the plane


class Reader:
    """Runs a text; `position` is asked for what G92 and increments need: a function from an axis to the machine coordinate."""

    def __init__(self, dialect, tools, offsets, position=None):
        self.dialect, self.tools, self.offsets = dialect, tools, offsets
        self.sinumerik = dialect == "sinumerik-840d"
        self.position = position
        self.motion, self.absolute, self.scale, self.feed_scale = "linear" if self.sinumerik else None, True, 1.0, 1.0
        self.plane, self.feed_mode, self.feed, self.speed = "G17", "G94", None, None
        self.tcp, self.vectors, self.length, self.tool, self.great_circle = False, False, 0.0, None, None
        self.zero, self.local, self.set = ({} if self.sinumerik else dict(offsets.get("G54", {}))), {}, {}
        self.codes, self.led, self.length_scale = {}, 0.0, 1.0
        self.tilt = None

    def shift(self):
        """What has to be added to words; None along an axis where G92 was said at a place that nobody knows."""
        known = {a: self.zero.get(a, 0.0) + self.local.get(a, 0.0) for a in LINEAR + ROTARY}
        return {a: None if self.set.get(a, 0.0) is None else v + self.set.get(a, 0.0) for a, v in known.items()}

    def blocks(self, text):
        for number, line in enumerate(text.splitlines(), 1):
            line = re.sub(r"\(.*?\)", "", line) if not self.sinumerik else line
            line = re.sub(r";.*", "", line).strip()
            if not line or line.startswith("%") or re.match(r"O\d+\s*$", line):
                continue
            if cycle := re.match(r"CYCLE800\((.*)\)$", line):
                yield number, cycle[1]
                continue
            words = []
            for name, kind, value in WORD.findall(re.sub(r"^N\d+\s*", "", line)):
                words.append((name, kind.rstrip("("), None if value == "" else float(value)))
            yield number, words

    def run(self, text):
        """Yields the motions in the order of the text. The one who takes them moves the machine before asking for the next."""
        for number, words in self.blocks(text):
            motion = self.block(number, words)
            if motion:
                yield motion

    def swivel(self, number):
        return Motion(number, "rapid", {}, self.tcp, self.length, self.shift(), None, tilt=self.tilt, swivel=True)

    def cycle800(self, number, arguments):
        if not arguments:
            self.tilt = None
            return None
        told = [float(x) if x and '"' not in x else 0.0 for x in arguments.split(",")]
        retract, _, more, mode, *rest, way = told
        found = planes.cycle800(int(mode), rest[3:6], tuple(rest[:3]), tuple(rest[6:9]))
        if retract or more or self.tcp or found is None:
            raise Unread("CYCLE800")
        self.tilt = found
        return self.swivel(number) if way else None

    def block(self, number, words):
        if isinstance(words, str):
            return self.cycle800(number, words)
        axes, arc, one, vector = {}, {}, None, {}
        before = self.length
        self.line_motion = any(n == "G" and v in (0, 1, 2, 3) for n, _, v in words)
        pending_h = None
        for name, kind, value in words:  # the codes of a block count for all of its words, wherever they stand
            if name in ("G", "M"):
                one = self.code(f"{name}{value:g}") or one
            elif len(name) > 2 and name.isalpha():
                one = self.name(name) or one
        for name, kind, value in words:
            if name in ("G", "M") or (len(name) > 2 and name.isalpha()):
                continue
            if name in LINEAR or name in ROTARY:
                if value is None:
                    raise Unread(name)
                scaled = value * self.scale if name in LINEAR else value
                axes[name] = (scaled, (not self.absolute) if not kind else kind == "IC")
            elif name in ("I", "J", "K", "R", "CR"):
                arc[name] = value
            elif name in ("A3", "B3", "C3"):
                vector[name] = value
            elif name == "F":
                self.feed = value * self.feed_scale if self.feed_mode != "G93" else value
            elif name == "S":
                self.speed = value
            elif name == "T":
                self.tool = int(value)
            elif name in ("H", "D"):
                pending_h = int(value)
            elif name in ("N", "O", "P", "Q", "L"):
                pass
            else:
                raise Unread(name)
        if self.dialect == "linuxcnc" and before and any(n == "G" and v in (43, 49) for n, _, v in words) and self.scale != self.length_scale:
            raise Unread("a length that is changed in another unit: the control keeps the number of the old one")
        self.length_scale = self.scale if pending_h is not None else self.length_scale
        if self.sinumerik and pending_h is not None:
            self.length = self.tools.get(self.tool, 0.0) if pending_h else 0.0
        elif pending_h is not None and (self.codes.get("length") or one == "H"):
            self.length = self.tools.get(pending_h, 0.0)
        if one in ("plane", "plane in plane"):
            if self.tcp or not self.absolute or one == "plane in plane" and not self.tilt:
                raise Unread("a plane from there")
            said = planes.euler(tuple(axes.get(a, (0.0,))[0] for a in LINEAR), *(arc.get(n, 0.0) for n in "IJK"))
            self.tilt = planes.within(self.tilt, said) if one == "plane in plane" else said
            return None
        if one == "swivel":
            if not self.tilt:
                raise Unread("G53.1 without a plane")
            return self.swivel(number)
        if self.tilt and (one or vector or self.tcp or any(a in axes for a in ROTARY)):
            raise Unread("this in a tilted plane")
        if one == "local" and self.dialect == "linuxcnc":  # one register for both
            self.set = self.set | {a: v for a, (v, _) in axes.items()}
            return None
        if one == "local":
            self.local = self.local | {a: v for a, (v, _) in axes.items()}
            return None
        if one in ("TRANS", "ATRANS"):
            base = self.local if one == "ATRANS" else {}
            self.local = base | {a: base.get(a, 0.0) + v for a, (v, _) in axes.items()}
            return None
        if one == "set":
            for a, (v, _) in axes.items():
                here = self.position(a, self)
                if here is None:
                    self.set[a] = None
                    continue
                self.set[a] = here - v - self.zero.get(a, 0.0) - self.local.get(a, 0.0)
            return None
        if self.dialect == "linuxcnc" and not axes and self.line_motion:
            raise Unread("a motion code without axes")
        if one == "dwell" or (not axes and not vector and not arc):
            return None
        if self.dialect == "linuxcnc" and self.feed_mode == "G95" and not self.speed:
            raise Unread("a feed per revolution of a spindle that stands")
        if self.motion in ("cw", "ccw") and not arc:
            raise Unread("an arc without a centre")
        if self.feed_mode == "G93" and self.motion != "rapid" and not any(n == "F" for n, _, _ in words):
            raise Unread("inverse time without F in the block")
        if self.motion is None or (self.motion != "rapid" and self.feed is None):
            raise Unread("motion or feed unset")
        if self.dialect == "linuxcnc" and self.tcp and self.length != self.led and (set("XYZ") - set(axes) or not self.absolute):
            raise Unread("what a new length means to X Y Z that are not named, while the kinematics leads the tip")
        self.led = self.length
        found = None
        if vector:
            found = tuple(vector.get(n, 0.0) for n in ("A3", "B3", "C3"))
        elif self.vectors and self.motion in ("rapid", "linear") and any(n in arc for n in "IJK"):
            found, arc = tuple(arc.get(n, 0.0) for n in "IJK"), {}
        elif arc and self.motion in ("rapid", "linear"):
            raise Unread("a centre without an arc")
        scale = self.scale
        return Motion(
            number, self.motion, axes, self.tcp, self.length, self.shift(), self.feed, self.feed_mode, one == "machine", found, self.plane,
            {n: v * scale for n, v in arc.items()}, self.speed, scale != 1.0, self.great_circle, self.tilt,
        )

    def code(self, code):
        motions = {"G0": "rapid", "G1": "linear", "G2": "cw", "G3": "ccw"}
        if code in motions:
            self.motion = motions[code]
        elif code in ("G90", "G91"):
            self.absolute = code == "G90"
        elif code in ("G17", "G18", "G19"):
            self.plane = code
        elif code in ("G93", "G94", "G95"):
            self.feed_mode, self.feed = code, None if code != self.feed_mode else self.feed
        elif code in ("G20", "G700", "G70"):
            self.scale, self.feed_scale = 25.4, 1.0 if code == "G70" else 25.4
        elif code in ("G21", "G710", "G71"):
            self.scale, self.feed_scale = 1.0, 1.0
        elif code in OFFSETS or re.match(r"G5\d\d$", code):
            self.zero = dict(self.offsets.get(code, {})) if code != "G500" else {}
        elif code == "G52":
            return "local"
        elif code == "G92":
            return "set"
        elif code == "G53":
            return "machine"
        elif code == "G4":
            return "dwell"
        elif code in ("G68.2", "G68.4"):
            return "plane" if code == "G68.2" else "plane in plane"
        elif code == "G53.1":
            return "swivel"
        elif code == "G69":
            self.tilt = None
        elif code in ("G43", "G43.4", "G43.5", "G234"):
            self.codes["length"] = True
            if self.dialect != "linuxcnc":
                self.tcp, self.vectors = code != "G43", code == "G43.5"
        elif code == "G49":
            self.length, self.codes["length"] = 0.0, False
            if self.dialect != "linuxcnc":
                self.tcp, self.vectors = False, False
        elif code in ("M428", "M429"):
            self.tcp = code == "M428"
        elif code in ("G40", "G64", "G80", "G641", "G642", "M3", "M4", "M5", "M6", "M8", "M9", "M30", "M2"):
            if self.sinumerik and code == "M6":
                self.length = self.tools.get(self.tool, 0.0)
        else:
            raise Unread(code)
        return None

    def name(self, name):
        if name in ("TRAORI", "TRAFOOF"):
            self.tcp = name == "TRAORI"
        elif name in ("ORIVECT", "ORIAXES"):
            self.great_circle = name == "ORIVECT"
        elif name in ("TRANS", "ATRANS"):
            return name
        elif name != "ORIWKS":
            raise Unread(name)
        return None
