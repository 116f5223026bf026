"""What a scene is made of, as plain data that knows no renderer. Right-handed; lengths in scene units, angles in
degrees, colours linear with 1 as white."""

import dataclasses

Vector = tuple[float, float, float]


@dataclasses.dataclass(frozen=True)
class Material:
    """A mirror's colour must be grey: Tachyon doesn't tint what a mirror shows."""
    color: Vector = (0.8, 0.8, 0.8)
    shininess: float = 0.0  # share of a mirror, 0..1


@dataclasses.dataclass(frozen=True)
class Sphere:
    center: Vector
    radius: float
    material: Material


@dataclasses.dataclass(frozen=True)
class Quad:
    origin: Vector
    width: Vector
    height: Vector
    material: Material


@dataclasses.dataclass(frozen=True)
class Cube:
    """Edges of length `size`, turned by `turn` about the y axis through its centre."""
    center: Vector
    size: float
    turn: float
    material: Material


@dataclasses.dataclass(frozen=True)
class Mesh:
    """The knot of make_mesh.py, of about so many triangles, at each of the places."""
    triangles: int
    material: Material
    places: tuple[Vector, ...] = ((0.0, 0.0, 0.0),)


@dataclasses.dataclass(frozen=True)
class Light:
    """A white point; strength 1 shows white as white, wherever it stands or, where it fades, at distance 1."""
    position: Vector
    strength: float
    fades: bool  # with 1/distance


@dataclasses.dataclass(frozen=True)
class World:
    name: str
    size: tuple[int, int]
    bounces: int
    camera: Vector
    look_at: Vector
    up: Vector
    vertical_fov: float
    background: Vector
    lights: list[Light]
    shapes: list
    samples: int = 1  # a square number; others than ours take a larger picture instead
