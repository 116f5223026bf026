"""The classic method once more, as plainly as it can be said, in double precision: the oracle of reference_test.py.

It shares nothing with the program but the words of the scene language's page. Its scene is a dictionary; text_of()
says the same in the language.
"""

import math


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def plus(a, b, factor=1.0):
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def unit(a):
    return plus((0, 0, 0), a, 1 / math.sqrt(dot(a, a)))


class Sphere:
    def __init__(self, center, radius, color, shininess):
        self.center, self.radius, self.color, self.shininess = center, radius, color, shininess

    def distance(self, origin, direction):
        """Along the ray (of unit length) to the nearest hit, or infinity."""
        offset = plus(origin, self.center, -1)
        b = dot(offset, direction)
        root = b * b - dot(offset, offset) + self.radius ** 2
        if root < 0:
            return math.inf
        root = math.sqrt(root)
        return -b - root if -b - root > 0 else -b + root if -b + root > 0 else math.inf

    def normal(self, point):
        return unit(plus(point, self.center, -1))

    def text(self):
        return f"sphere {{ center {words(self.center)}  radius {self.radius!r}  {material(self)} }}"


class Quad:
    def __init__(self, origin, width, height, color, shininess):
        self.origin, self.width, self.height, self.color, self.shininess = origin, width, height, color, shininess
        self.area = cross(width, height)

    def distance(self, origin, direction):
        slope = dot(self.area, direction)
        if slope == 0:
            return math.inf
        t = dot(self.area, plus(self.origin, origin, -1)) / slope
        inside = plus(plus(origin, direction, t), self.origin, -1)
        u = dot(cross(inside, self.height), self.area) / dot(self.area, self.area)
        v = dot(cross(self.width, inside), self.area) / dot(self.area, self.area)
        return t if t > 0 and 0 <= u <= 1 and 0 <= v <= 1 else math.inf

    def normal(self, _):
        return unit(self.area)

    def text(self):
        return (f"quad {{ origin {words(self.origin)}  width {words(self.width)}  height {words(self.height)}  "
                f"{material(self)} }}")


def words(numbers):
    return " ".join(repr(float(x)) for x in numbers)


def material(shape):
    return f"material {{ color {words(shape.color)}  shininess {shape.shininess!r} }}"


def text_of(scene):
    """The scene in the language of the program."""
    camera = scene["camera"]
    lines = [
        f"camera {{ position {words(camera['position'])}  look_at {words(camera['look_at'])}  "
        f"up {words(camera['up'])}  vertical_fov {camera['vertical_fov']!r} }}",
        f"background {{ color {words(scene['background'])} }}",
        f"render {{ ambient {words(scene['ambient'])}  bounces {scene['bounces']} }}",
    ]
    for light in scene["lights"]:
        properties = "  ".join(
            f"{name} {value if isinstance(value, str) else words(value) if isinstance(value, tuple) else repr(value)}"
            for name, value in light.items() if name != "kind")
        lines.append(f"light {light['kind']} {{ {properties} }}")
    return "\n".join(lines + [shape.text() for shape in scene["shapes"]]) + "\n"


def nearest(shapes, origin, direction):
    best = math.inf, None
    for shape in shapes:
        t = shape.distance(origin, direction)
        if t < best[0]:
            best = t, shape
    return best


def light_at(light, point, normal):
    """(value that a white surface returns, unit direction to the light, how far it is)."""
    kind = light["kind"]
    if kind == "directional":
        to_light, distance, fade = plus((0, 0, 0), unit(light["direction"]), -1), math.inf, 1.0
    else:
        offset = plus(light["position"], point, -1)
        distance = math.sqrt(dot(offset, offset))
        to_light = unit(offset)
        fade = distance ** -{"none": 0, "linear": 1, "quadratic": 2}[light["falloff"]]
    if kind == "spot":
        axis = unit(plus(light["look_at"], light["position"], -1))
        cosine = -dot(axis, to_light)
        outer = math.cos(math.radians(light["angle"] / 2))
        inner = math.cos(math.radians(light["angle"] / 2 * (1 - light["soft_edge"])))
        share = 1.0 if cosine >= inner else 0.0 if cosine <= outer else (cosine - outer) / (inner - outer)
        fade *= share * share * (3 - 2 * share)
    strength = light["intensity"] / 255 * fade * max(dot(to_light, normal), 0.0)
    return [strength * c for c in light["color"]], to_light, distance


def color_along(scene, origin, direction, bounces):
    t, shape = nearest(scene["shapes"], origin, direction)
    if shape is None:
        return scene["background"]
    point = plus(origin, direction, t)
    normal = shape.normal(point)
    if dot(normal, direction) > 0:
        normal = plus((0, 0, 0), normal, -1)
    start = plus(point, normal, 1e-9)
    mirror = min(max(shape.shininess, 0.0), 1.0)
    arriving = list(scene["ambient"])
    for light in scene["lights"]:
        value, to_light, distance = light_at(light, point, normal)
        if any(value) and mirror < 1 and nearest(scene["shapes"], start, to_light)[0] >= distance:
            arriving = [a + v for a, v in zip(arriving, value)]
    seen = (0.0, 0.0, 0.0)
    if mirror > 0 and bounces > 0:
        seen = color_along(scene, start, plus(direction, normal, -2 * dot(direction, normal)), bounces - 1)
    return tuple(c * ((1 - mirror) * a + mirror * s) for c, a, s in zip(shape.color, arriving, seen))


def render(scene, width, height):
    """Values r, g, b of every pixel's centre, row by row from the top left."""
    camera = scene["camera"]
    forward = unit(plus(camera["look_at"], camera["position"], -1))
    right = unit(cross(forward, camera["up"]))
    up = cross(right, forward)
    tangent = math.tan(math.radians(camera["vertical_fov"]) / 2)
    values = []
    for j in range(height):
        for i in range(width):
            across = (2 * (i + 0.5) / width - 1) * tangent * width / height
            upwards = (1 - 2 * (j + 0.5) / height) * tangent
            direction = unit(plus(plus(forward, right, across), up, upwards))
            values += color_along(scene, camera["position"], direction, scene["bounces"])
    return values
