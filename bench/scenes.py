"""The fixed scenes of the benchmark."""

import math

from world import Cube, Light, Material, Mesh, Quad, Sphere, World


def tiny():
    """One sphere on 64x64 pixels: what a start costs."""
    return World(
        name="tiny", size=(64, 64), bounces=8, camera=(0, 0, 4), look_at=(0, 0, 0), up=(0, 1, 0), vertical_fov=40,
        background=(0, 0, 0), lights=[Light((3, 4, 5), 6, fades=True)],
        shapes=[Sphere((0, 0, 0), 1, Material((0.9, 0.5, 0.2)))])


def classic():
    """Twelve spheres, every third part mirror, a floor, two cubes, one light: what the founding paper draws."""
    colors = [(0.9, 0.3, 0.2), (0.9, 0.7, 0.2), (0.85, 0.85, 0.85), (0.3, 0.7, 0.3), (0.2, 0.5, 0.9), (0.9, 0.9, 0.9)]
    spheres = []
    for i in range(12):
        angle = 2 * math.pi * i / 12
        ring, height = (3.0, 0.8) if i % 2 else (4.6, 0.5)
        spheres.append(Sphere((ring * math.sin(angle), height, ring * math.cos(angle)), height,
                              Material(colors[i % 6], 0.7 if i % 3 == 2 else 0.0)))
    return World(
        name="classic", size=(1920, 1080), bounces=8, camera=(1.5, 4.2, 10), look_at=(0, 0.6, 0), up=(0, 1, 0),
        vertical_fov=35, background=(0.25, 0.4, 0.65), lights=[Light((-6, 9, 7), 12, fades=True)],
        shapes=spheres + [
            Quad((-30, 0, 30), (60, 0, 0), (0, 0, -60), Material((0.8, 0.8, 0.8))),
            Cube((-0.7, 0.6, 0.3), 1.2, 0, Material((0.8, 0.8, 0.8), 0.4)),
            Cube((0.9, 0.45, 0.9), 0.9, 30, Material((0.3, 0.4, 0.8)))])


def sphereflake(name, depth):
    """Spheres on spheres, nine on each, `depth` times: the scene 'balls' of E. Haines, "A Proposal for Standard
    Graphics Environments", IEEE Computer Graphics and Applications 7(11), 1987, with its camera and lights."""
    ball = Material((0.8, 0.8, 0.8), 0.5)
    shapes = [Quad((-6, -6, -0.5), (12, 0, 0), (0, 12, 0), Material((1.0, 0.75, 0.33)))]
    add_flake(shapes, depth, (0.0, 0.0, 0.0), 0.5, (0.0, 0.0, 1.0), ball)
    return World(
        name=name, size=(1024, 1024), bounces=5, camera=(2.1, 1.3, 1.7), look_at=(0, 0, 0), up=(0, 0, 1),
        vertical_fov=45, background=(0.078, 0.361, 0.753),
        lights=[Light(p, 0.5, fades=False) for p in ((4, 3, 2), (1, -4, 4), (-3, 1, 5))], shapes=shapes)


def add_flake(shapes, depth, center, radius, pole, material):
    """A sphere, and on it six around its equator and three around its `pole`, a third as large."""
    shapes.append(Sphere(center, radius, material))
    if depth == 0:
        return
    first, second = axes_across(pole)
    for height, count, offset in ((0.0, 6, 0.0), (math.sqrt(2 / 3), 3, 30.0)):
        reach = math.sqrt(1 - height * height)
        for i in range(count):
            angle = math.radians(offset + 360 * i / count)
            a, b = reach * math.cos(angle), reach * math.sin(angle)
            direction = tuple(a * f + b * s + height * p for f, s, p in zip(first, second, pole))
            outer = tuple(c + radius * 4 / 3 * d for c, d in zip(center, direction))
            add_flake(shapes, depth - 1, outer, radius / 3, direction, material)


def axes_across(pole):
    """Two unit vectors across the unit vector `pole` and each other."""
    x, y, z = pole
    helper = (1.0, 0.0, 0.0) if abs(x) < 0.6 else (0.0, 1.0, 0.0)
    first = normalized(cross(helper, (x, y, z)))
    return first, cross((x, y, z), first)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def mesh():
    """A knot of 872,000 triangles, one light, hard shadows, four samples."""
    return World(
        name="mesh", size=(1920, 1080), bounces=8, camera=(0, -3, 8), look_at=(0, 0, 0), up=(0, 1, 0), vertical_fov=45,
        background=(0.25, 0.4, 0.65), lights=[Light((-6, 9, 7), 12, fades=True)],
        shapes=[Mesh(872002, Material((0.8, 0.8, 0.8)))], samples=4)


def instances():
    """10,000 knots of 50,000 triangles each on a floor."""
    places = tuple((8.0 * i, 3.5, -8.0 * k) for k in range(100) for i in range(-50, 50))
    return World(
        name="instances", size=(1920, 1080), bounces=8, camera=(0, 40, 60), look_at=(0, 0, -60), up=(0, 1, 0),
        vertical_fov=45, background=(0.25, 0.4, 0.65), lights=[Light((-300, 400, 100), 500, fades=True)],
        shapes=[Mesh(50000, Material((0.9, 0.5, 0.2)), places),
                Quad((-2000, 0, 200), (4000, 0, 0), (0, 0, -4000), Material((0.8, 0.8, 0.8)))])


ALL = {
    "tiny": tiny,
    "classic": classic,
    "sphereflake-7k": lambda: sphereflake("sphereflake-7k", 4),
    "sphereflake-66k": lambda: sphereflake("sphereflake-66k", 5),
    "mesh": mesh,
    "instances": instances,
}
