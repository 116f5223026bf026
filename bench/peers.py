#!/usr/bin/env python3
"""Measures `method path` on two scenes against Mitsuba 3, where the Python that runs this has it: whole processes, in
turns, each turn with another seed. Prints a table; --json keeps every number. Needs NumPy. For Mitsuba's vectorised
mode DRJIT_LIBLLVM_PATH must name a libLLVM of 16 or newer.

The squared error is the variance between turns, relative to the picture's square + 0.01, without the worst 0.1 % of
pixels: of unbiased pictures that is the error, and it asks for no reference. `mean` is the picture's mean over ours:
it tells whether the renderers mean the same scene."""

import argparse
import dataclasses
import importlib.util
import json
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import make_mesh  # noqa: E402
from bench_process import measure  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
VARIANTS = {"mitsuba": "llvm_ad_rgb", "mitsuba-scalar": "scalar_rgb"}


@dataclasses.dataclass(frozen=True)
class Matt:
    color: tuple

    def ours(self):
        return "material { color %g %g %g }" % self.color

    def theirs(self):
        return {"type": "twosided", "inside": {"type": "diffuse", "reflectance": rgb(self.color)}}


@dataclasses.dataclass(frozen=True)
class Glass:
    def ours(self):
        return "material { transmission 1 ior 1.5 }"

    def theirs(self):
        return {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0}


@dataclasses.dataclass(frozen=True)
class Metal:
    eta: tuple
    k: tuple
    alpha: float

    def ours(self):
        return ("material { metallic 1 roughness %.7g eta %g %g %g k %g %g %g energy_compensation false }"
                % (self.alpha ** 0.5, *self.eta, *self.k))

    def theirs(self):
        return {"type": "twosided", "inside": {"type": "roughconductor", "distribution": "ggx", "alpha": self.alpha,
                                               "eta": rgb(self.eta), "k": rgb(self.k)}}


@dataclasses.dataclass(frozen=True)
class Quad:
    """With `radiance` it shines on the side of width x height and reflects nothing."""
    origin: tuple
    width: tuple
    height: tuple
    material: object = None
    radiance: tuple = None

    def ours(self, _):
        edges = "origin %g %g %g width %g %g %g height %g %g %g" % (*self.origin, *self.width, *self.height)
        if self.radiance is not None:
            return "light area { %s radiance %g %g %g }" % (edges, *self.radiance)
        return "quad { %s %s }" % (edges, self.material.ours())

    def theirs(self, mitsuba, _):
        o, a, b = (list(map(float, v)) for v in (self.origin, self.width, self.height))
        normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        length = sum(x * x for x in normal) ** 0.5
        rows = [[a[i] / 2, b[i] / 2, normal[i] / length, o[i] + a[i] / 2 + b[i] / 2] for i in range(3)]
        shape = {"type": "rectangle", "to_world": mitsuba.ScalarTransform4f([*rows, [0, 0, 0, 1]])}
        if self.radiance is None:
            return shape | {"bsdf": self.material.theirs()}
        return shape | {"bsdf": {"type": "diffuse", "reflectance": rgb((0, 0, 0))},
                        "emitter": {"type": "area", "radiance": rgb(self.radiance)}}


@dataclasses.dataclass(frozen=True)
class Knot:
    """Each of its own file, so that none of the renderers can store one for all."""
    triangles: int
    place: tuple
    size: float
    material: object

    def file(self, folder):
        path = folder / f"knot-{self.triangles}.ply"
        if not path.exists():
            make_mesh.write_knot(path, self.triangles, with_normals=False)
        return path

    def ours(self, folder):
        return ('mesh { file "%s" pivot 0 0 0 scale %g translate %g %g %g %s }'
                % (self.file(folder).name, self.size, *self.place, self.material.ours()))

    def theirs(self, mitsuba, folder):
        place = mitsuba.ScalarTransform4f().translate(self.place).scale(self.size)
        return {"type": "ply", "filename": str(self.file(folder)), "face_normals": True, "to_world": place,
                "bsdf": self.material.theirs()}


@dataclasses.dataclass(frozen=True)
class World:
    name: str
    size: tuple
    samples: int
    bounces: int
    camera: tuple
    look_at: tuple
    vertical_fov: float
    sky: tuple
    things: list


def rgb(color):
    return {"type": "rgb", "value": list(color)}


def cornell():
    """Two boxes and one light in a room; all matt."""
    text = (ROOT / "tests/data/reference/cornell_box.txt").read_text()
    numbers = r"((?:\s+-?[\d.]+){3})"
    triple = lambda words: tuple(map(float, words.split()))  # noqa: E731
    materials = {name: Matt(triple(color)) for name, color in re.findall(r"material (\w+) \{ color" + numbers, text)}
    edges = rf"origin{numbers}\s+width{numbers}\s+height{numbers}\s+"
    things = [Quad(*map(triple, found[:3]), materials[found[3]])
              for found in re.findall(rf"quad \{{ {edges}material (\w+)", text)]
    things += [Quad(*map(triple, found[:3]), radiance=triple(found[3]))
               for found in re.findall(rf"light area \{{ {edges}radiance{numbers}", text)]
    return World("cornell", (512, 512), 256, 7, (0, 1, 3.9), (0, 1, 0), 39.3, (0, 0, 0), things)


def knots():
    """A glass, a rough gold and a red knot, a million triangles in all, under a sky and a light."""
    gold = Metal((0.143, 0.375, 1.442), (3.983, 2.386, 1.603), 0.2)
    return World(
        "knots", (1280, 720), 64, 15, (0, 2.2, 7.5), (0, 0.9, 0), 32, (0.5, 0.6, 0.8),
        [Quad((-20, 0, 20), (40, 0, 0), (0, 0, -40), Matt((0.6, 0.6, 0.6))),
         Knot(336000, (-2.4, 1.1, 0), 0.32, Glass()), Knot(337000, (0, 1.1, 0), 0.32, gold),
         Knot(338000, (2.4, 1.1, 0), 0.32, Matt((0.7, 0.08, 0.05))),
         Quad((-1, 4, -1), (2, 0, 0), (0, 0, 2), radiance=(12, 11, 10))])


WORLDS = {"cornell": cornell, "knots": knots}


def our_text(world, folder):
    lines = [f"image {{ size {world.size[0]} {world.size[1]} }}",
             "camera { position %g %g %g look_at %g %g %g vertical_fov %g }"
             % (*world.camera, *world.look_at, world.vertical_fov),
             f"render {{ method path samples {world.samples} bounces {world.bounces} }}",
             "background { color %g %g %g }" % world.sky]
    return "\n".join(lines + [thing.ours(folder) for thing in world.things]) + "\n"


def run_mitsuba(variant, world, folder, seed, picture):
    """In a process of its own: renders, and says on standard output how long the rendering alone took."""
    import time

    import mitsuba
    import numpy
    mitsuba.set_variant(variant)
    look = mitsuba.ScalarTransform4f().look_at(origin=world.camera, target=world.look_at, up=(0, 1, 0))
    film = {"type": "hdrfilm", "width": world.size[0], "height": world.size[1], "rfilter": {"type": "box"},
            "pixel_format": "rgb", "component_format": "float32"}
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": world.bounces + 1},
             "sensor": {"type": "perspective", "fov": world.vertical_fov, "fov_axis": "y", "to_world": look, "film": film,
                        "sampler": {"type": "independent", "sample_count": world.samples}}}
    if any(world.sky):
        scene["sky"] = {"type": "constant", "radiance": rgb(world.sky)}
    for i, thing in enumerate(world.things):
        scene[f"thing{i}"] = thing.theirs(mitsuba, folder)
    scene = mitsuba.load_dict(scene)
    start = time.perf_counter()
    pixels = numpy.array(mitsuba.render(scene, spp=world.samples, seed=seed))
    print(json.dumps({"render": time.perf_counter() - start}))
    numpy.save(picture, pixels)


def read_pfm(path):
    import numpy
    raw = path.read_bytes()
    head = re.match(rb"PF\s+(\d+)\s+(\d+)\s+-[\d.]+\s", raw)
    return numpy.frombuffer(raw, "<f4", offset=head.end()).reshape(int(head[2]), int(head[1]), 3)[::-1]


def measure_ours(arguments, world, folder, seed):
    picture, stats = folder / "ours.pfm", folder / "stats.json"
    run = measure([arguments.program, folder / f"{world.name}.txt", "-o", picture, "--seed", str(seed), "--threads",
                   str(arguments.threads), "--stats", stats])
    told = json.loads(stats.read_text())
    return run | {"render": told["render"], "mrays": told["rays"] / told["render"] / 1e6}, read_pfm(picture)


def measure_mitsuba(arguments, variant, world, folder, seed):
    import numpy
    picture, said = folder / "mitsuba.npy", folder / "said.json"
    with said.open("w") as output:
        run = measure([sys.executable, __file__, "--mitsuba", variant, "--scenes", world.name, "--seed", str(seed),
                       "--folder", folder, "--share", str(arguments.share)], output)
    return run | json.loads(said.read_text().splitlines()[-1]), numpy.load(picture)


def squared_error(pictures):
    """Of one picture, by how much the pictures of several seeds differ."""
    import numpy
    stack = numpy.asarray(pictures, dtype=numpy.float64)
    mean = stack.mean(axis=0)
    error = numpy.sort((stack.var(axis=0, ddof=1) / (mean * mean + 0.01)).mean(axis=-1).ravel())
    return float(error[:int(0.999 * len(error))].mean())


def bench(arguments, world, folder):
    (folder / f"{world.name}.txt").write_text(our_text(world, folder))
    runs, pictures = {}, {}
    for turn in range(arguments.repeat):
        for name in arguments.renderers:
            if name == "raytracer":
                run, picture = measure_ours(arguments, world, folder, turn)
            else:
                run, picture = measure_mitsuba(arguments, VARIANTS[name], world, folder, turn)
            runs.setdefault(name, []).append(run)
            pictures.setdefault(name, []).append(picture)
    results = {}
    for name, each in runs.items():
        result = {key: min(run[key] for run in each) for key in ("wall", "cpu", "render")}
        result |= {"peak_mb": max(run["peak_mb"] for run in each), "runs": each}
        if "mrays" in each[0]:
            result["mrays"] = max(run["mrays"] for run in each)
        result["mean"] = float(sum(map(lambda p: p.mean(), pictures[name])) / len(each)
                               / (sum(map(lambda p: p.mean(), pictures["raytracer"])) / len(each)))
        if len(each) > 1:
            result["squared_error"] = squared_error(pictures[name])
            result["efficiency"] = 1 / (result["squared_error"] * result["wall"])
        results[name] = result
    return results


def print_results(world, results):
    for name, result in results.items():
        mrays = f"{result['mrays']:8.2f}" if "mrays" in result else 8 * " "
        error = (f"{result['squared_error']:11.5f} {result['efficiency']:10.2f}" if "squared_error" in result else "")
        print(f"{world.name:8} {name:15} {result['wall']:8.2f} {result['render']:8.2f} {result['cpu']:8.2f} {mrays} "
              f"{result['peak_mb']:7.0f} {result['mean']:6.3f} {error}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "raytracer")
    parser.add_argument("--scenes", nargs="+", choices=WORLDS, default=list(WORLDS))
    parser.add_argument("--renderers", nargs="+", choices=["raytracer", *VARIANTS],
                        help="default: ours, and Mitsuba's vectorised mode where it is installed")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--share", type=float, default=1, help="of the samples: for a quick look")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--mitsuba", choices=VARIANTS.values(), help=argparse.SUPPRESS)
    parser.add_argument("--folder", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--seed", type=int, default=0, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    worlds = [WORLDS[name]() for name in arguments.scenes]
    worlds = [dataclasses.replace(w, samples=max(1, round(w.samples * arguments.share))) for w in worlds]
    if arguments.mitsuba:
        run_mitsuba(arguments.mitsuba, worlds[0], arguments.folder, arguments.seed, arguments.folder / "mitsuba.npy")
        return
    if arguments.renderers is None:
        arguments.renderers = ["raytracer"] + (["mitsuba"] if importlib.util.find_spec("mitsuba") else [])
    print(f"{'scene':8} {'renderer':15} {'wall s':>8} {'render':>8} {'cpu s':>8} {'Mrays/s':>8} {'peak MB':>7} "
          f"{'mean':>6} {'sq. error':>11} {'efficiency':>10}")
    everything = {}
    with tempfile.TemporaryDirectory() as folder:
        for world in worlds:
            everything[world.name] = bench(arguments, world, pathlib.Path(folder))
            print_results(world, everything[world.name])
    if arguments.json:
        arguments.json.write_text(json.dumps(everything, indent=1) + "\n")


if __name__ == "__main__":
    main()
