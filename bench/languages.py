"""Writes a World in the languages of the renderers that are compared, so that each does the same work: the same
rays, no antialiasing, no highlights, no gamma curve."""

import dataclasses
import math

import knots
from world import Cube, Mesh, Quad, Sphere


def numbers(*values):
    return " ".join(f"{v:.9g}" for v in values)


# --- ours -------------------------------------------------------------------------------------------------------

def to_raytracer(world, folder):
    lines = [
        "raytracer 1",
        f"image {{ size {world.size[0]} {world.size[1]} }}",
        f"render {{ bounces {world.bounces} samples {world.samples} }}",
        f"camera {{ position {numbers(*world.camera)} look_at {numbers(*world.look_at)} up {numbers(*world.up)} "
        f"vertical_fov {world.vertical_fov} }}",
        f"background {{ color {numbers(*world.background)} }}",
    ]
    for light in world.lights:
        lines.append(f"light {{ position {numbers(*light.position)} intensity {numbers(255 * light.strength)} "
                     f"falloff {'linear' if light.fades else 'none'} }}")
    materials = list(dict.fromkeys(shape.material for shape in world.shapes))
    for i, material in enumerate(materials):
        lines.append(f"material m{i} {{ color {numbers(*material.color)} shininess {material.shininess:g} }}")
    for shape in world.shapes:
        material = f"material m{materials.index(shape.material)} }}"
        if isinstance(shape, Mesh):
            name = knots.file(shape.triangles, folder).name
            lines.extend(f'mesh {{ file "{name}" translate {numbers(*place)} {material}' for place in shape.places)
        else:
            lines.append(f"{raytracer_shape(shape)} {material}")
    return "\n".join(lines) + "\n"


def raytracer_shape(shape):
    match shape:
        case Sphere():
            return f"sphere {{ center {numbers(*shape.center)} radius {numbers(shape.radius)}"
        case Quad():
            return (f"quad {{ origin {numbers(*shape.origin)} width {numbers(*shape.width)} "
                    f"height {numbers(*shape.height)}")
        case Cube():
            turn = f" rotate 0 {shape.turn:g} 0" if shape.turn else ""
            return f"cube {{ center {numbers(*shape.center)} size {numbers(shape.size)}{turn}"


# --- the yardstick's ---------------------------------------------------------------------------------------------

def to_limit(world, folder):
    """Kinds with plain numbers; cubes are six quads, and what has one material stands together. None for a world with
    meshes that are not in their own place, which it does not know."""
    if any(shape.places != Mesh.places for shape in world.shapes if isinstance(shape, Mesh)):
        return None
    lines = [
        f"picture {numbers(*world.size, world.samples, world.bounces)}",
        f"camera {numbers(*world.camera, *world.look_at, *world.up, world.vertical_fov)}",
        f"background {numbers(*world.background)}",
    ]
    lines.extend(f"lamp {numbers(*light.position, 255 * light.strength, light.fades)}" for light in world.lights)
    for material in dict.fromkeys(shape.material for shape in world.shapes):
        lines.append(f"surface {numbers(*material.color, material.shininess)}")
        lines.extend(line for shape in world.shapes if shape.material == material for line in limit_shape(shape, folder))
    return "\n".join(lines) + "\n"


def limit_shape(shape, folder):
    match shape:
        case Sphere():
            return [f"sphere {numbers(*shape.center, shape.radius)}"]
        case Quad():
            return [f"quad {numbers(*shape.origin, *shape.width, *shape.height)}"]
        case Cube():
            return [line for face in faces(shape) for line in limit_shape(face, folder)]
        case Mesh():
            return [f"mesh {knots.file(shape.triangles, folder)}"]


# --- POV-Ray ----------------------------------------------------------------------------------------------------

def to_povray(world, folder):
    # POV-Ray is left-handed: a right-handed camera has its `right` turned round. adc_bailout 0: no ray is dropped.
    width, height = world.size
    horizontal = math.degrees(2 * math.atan(math.tan(math.radians(world.vertical_fov) / 2) * width / height))
    lines = [
        "#version 3.7;",
        f"global_settings {{ assumed_gamma 1 max_trace_level {world.bounces + 1} adc_bailout 0 }}",
        f"camera {{ location {pov(world.camera)} right <{numbers(-width / height)}, 0, 0> sky {pov(world.up)} "
        f"angle {numbers(horizontal)} look_at {pov(world.look_at)} }}",
        f"background {{ rgb {pov(world.background)} }}",
    ]
    for light in world.lights:
        # It fades with 2 / (1 + distance / fade_distance); far beyond that distance this is 1/distance.
        near = 1e-4
        fade = f" fade_distance {near} fade_power 1" if light.fades else ""
        strength = light.strength / (2 * near) if light.fades else light.strength
        lines.append(f"light_source {{ {pov(light.position)} rgb {numbers(strength)}{fade} }}")
    materials = list(dict.fromkeys(shape.material for shape in world.shapes))
    for i, material in enumerate(materials):
        s = material.shininess
        mirror = f" reflection {{ rgb {pov(tuple(s * c for c in material.color))} }}" if s > 0 else ""
        lines.append(f"#declare M{i} = texture {{ pigment {{ rgb {pov(material.color)} }} "
                     f"finish {{ ambient 0 diffuse {1 - s:g}{mirror} }} }}")
    for shape in world.shapes:
        texture = f"texture {{ M{materials.index(shape.material)} }}"
        lines.extend(pov_mesh(shape, texture, folder) if isinstance(shape, Mesh) else [pov_shape(shape, texture)])
    return "\n".join(lines) + "\n"


def pov(vector):
    return "<" + ", ".join(f"{v:.9g}" for v in vector) + ">"


def pov_mesh(mesh, texture, folder):
    points, triangles = knots.read(knots.file(mesh.triangles, folder))
    yield f"#declare K = mesh2 {{ vertex_vectors {{ {len(points)}, " + ", ".join(map(pov, points)) + " }"
    yield f"face_indices {{ {len(triangles)}, " + ", ".join("<%d, %d, %d>" % t for t in triangles) + f" }} {texture} }}"
    for place in mesh.places:
        yield f"object {{ K translate {pov(place)} }}"


def pov_shape(shape, texture):
    match shape:
        case Sphere():
            return f"sphere {{ {pov(shape.center)}, {numbers(shape.radius)} {texture} }}"
        case Quad():
            return "\n".join(f"triangle {{ {', '.join(map(pov, corners))} {texture} }}" for corners in halves(shape))
        case Cube():
            half = (shape.size / 2,) * 3
            turn = f"rotate <0, {shape.turn:g}, 0> " if shape.turn else ""
            return (f"box {{ {pov(tuple(-h for h in half))}, {pov(half)} {turn}translate {pov(shape.center)} "
                    f"{texture} }}")


def halves(quad):
    a = quad.origin
    b = tuple(map(sum, zip(a, quad.width)))
    c = tuple(map(sum, zip(b, quad.height)))
    d = tuple(map(sum, zip(a, quad.height)))
    return (a, b, c), (a, c, d)


# --- Tachyon ----------------------------------------------------------------------------------------------------

def to_tachyon(world, folder):
    # Tachyon's pictures are mirror images of a right-handed world.
    world = mirrored(world)
    width, height = world.size
    view = tuple(b - a for a, b in zip(world.camera, world.look_at))
    lines = [
        "BEGIN_SCENE",
        f"RESOLUTION {width} {height}",
        "CAMERA",
        f"  ZOOM {numbers(1 / math.tan(math.radians(world.vertical_fov) / 2) / 2)}",
        "  ASPECTRATIO 1",
        "  ANTIALIASING 0",
        f"  RAYDEPTH {world.bounces + 1}",
        f"  CENTER {numbers(*world.camera)}",
        f"  VIEWDIR {numbers(*view)}",
        f"  UPDIR {numbers(*world.up)}",
        "END_CAMERA",
        f"BACKGROUND {numbers(*world.background)}",
    ]
    for light in world.lights:
        fade = " ATTENUATION CONSTANT 0 LINEAR 1 QUADRATIC 0" if light.fades else ""
        lines.append(f"LIGHT CENTER {numbers(*light.position)} RAD 0.001{fade} COLOR {numbers(*[light.strength] * 3)}")
    for i, material in enumerate(dict.fromkeys(shape.material for shape in world.shapes)):
        s = material.shininess
        lines.append(f"TEXDEF m{i} AMBIENT 0 DIFFUSE {1 - s:g} SPECULAR {numbers(s * material.color[0])} OPACITY 1 "
                     f"COLOR {numbers(*material.color)} TEXFUNC 0")
    materials = list(dict.fromkeys(shape.material for shape in world.shapes))
    for shape in world.shapes:
        texture = f"m{materials.index(shape.material)}"
        lines.extend(tachyon_mesh(shape, texture, folder) if isinstance(shape, Mesh) else tachyon_shape(shape, texture))
    lines.append("END_SCENE")
    return "\n".join(lines) + "\n"


def mirrored(world):
    """The world with x turned round."""
    def flip(v):
        return (-v[0], v[1], v[2])

    def flip_shape(shape):
        match shape:
            case Sphere():
                return dataclasses.replace(shape, center=flip(shape.center))
            case Quad():
                return dataclasses.replace(shape, origin=flip(shape.origin), width=flip(shape.width),
                                           height=flip(shape.height))
            case Cube():
                return dataclasses.replace(shape, center=flip(shape.center), turn=-shape.turn)
            case Mesh():  # its points are turned round where they are written
                return dataclasses.replace(shape, places=tuple(map(flip, shape.places)))

    return dataclasses.replace(
        world, camera=flip(world.camera), look_at=flip(world.look_at), up=flip(world.up),
        lights=[dataclasses.replace(light, position=flip(light.position)) for light in world.lights],
        shapes=[flip_shape(shape) for shape in world.shapes])


def tachyon_mesh(mesh, texture, folder):
    """Every triangle in every place: Tachyon has no instances."""
    points, triangles = knots.read(knots.file(mesh.triangles, folder))
    for x, y, z in mesh.places:
        for triangle in triangles:
            a, b, c = ((x - points[i][0], y + points[i][1], z + points[i][2]) for i in triangle)
            yield f"TRI V0 {numbers(*a)} V1 {numbers(*b)} V2 {numbers(*c)} {texture}"


def tachyon_shape(shape, texture):
    match shape:
        case Sphere():
            return [f"SPHERE CENTER {numbers(*shape.center)} RAD {numbers(shape.radius)} {texture}"]
        case Quad():
            return tachyon_quad(shape, texture)
        case Cube() if shape.turn == 0:
            half = shape.size / 2
            return [f"BOX MIN {numbers(*(c - half for c in shape.center))} "
                    f"MAX {numbers(*(c + half for c in shape.center))} {texture}"]
        case Cube():
            return [line for face in faces(shape) for line in tachyon_quad(face, texture)]


def tachyon_quad(quad, texture):
    return [f"TRI V0 {numbers(*a)} V1 {numbers(*b)} V2 {numbers(*c)} {texture}" for a, b, c in halves(quad)]


def faces(cube):
    """The six squares of a cube, for Tachyon, whose boxes can't be turned, and for the yardstick."""
    turn, size = math.radians(cube.turn), cube.size
    edges = ((size * math.cos(turn), 0, -size * math.sin(turn)), (0, size, 0),
             (size * math.sin(turn), 0, size * math.cos(turn)))
    corner = tuple(c - sum(e) / 2 for c, e in zip(cube.center, zip(*edges)))
    for i in range(3):
        width, height, across = edges[i], edges[(i + 1) % 3], edges[(i + 2) % 3]
        yield Quad(corner, width, height, cube.material)
        yield Quad(tuple(map(sum, zip(corner, across))), width, height, cube.material)
