#!/usr/bin/env python3
"""Draws label.png, the paper around the honey of kitchen-shelf.txt. Needs Pillow, and DejaVu Serif."""

import math
import pathlib

from PIL import Image, ImageDraw, ImageFont

WIDTH, HEIGHT = 768, 256
PAPER, INK, GOLD, LIGHT_GOLD, GREEN = (240, 228, 198), (96, 40, 22), (196, 140, 40), (228, 180, 70), (74, 104, 52)

picture = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
pen = ImageDraw.Draw(picture)


def write(text, size, y, color):
    font = ImageFont.truetype("DejaVuSerif-Bold.ttf", size)
    pen.text(((WIDTH - pen.textlength(text, font=font)) / 2, y), text, font=font, fill=color)


def comb(x, y, radius, color):
    corners = [math.radians(60 * k + 30) for k in range(6)]
    pen.polygon([(x + radius * math.cos(a), y + radius * math.sin(a)) for a in corners], fill=color, outline=INK)


for y, thickness, color in ((8, 6, GOLD), (HEIGHT - 14, 6, GOLD), (18, 2, INK), (HEIGHT - 22, 2, INK)):
    pen.rectangle([0, y, WIDTH, y + thickness], fill=color)
write("HONEY", 74, 52, INK)
write("of the lime trees", 26, 140, GREEN)
write("* 2026 *", 22, 188, GOLD)
for side in (-1, 1):
    for column in range(3):
        for row in range(3 - column % 2):
            color = GOLD if (row + column) % 2 else LIGHT_GOLD
            comb(WIDTH / 2 + side * (186 + 26 * column), 98 + 30 * row + 15 * (column % 2), 17, color)
picture.quantize(16).save(pathlib.Path(__file__).with_name("label.png"), optimize=True)
