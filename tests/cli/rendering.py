# SPDX-License-Identifier: Apache-2.0
"""Small pictures of the ash from leafhull render."""

import json

import png
from command import ASH, CommandTest

DRAFT = ("--preset", "draft")
SMALL = (*DRAFT, "--size", "96x96")
MESH = ("--surface", "mesh")
WHITE = (255, 255, 255)


def is_green(pixel):
    return pixel[1] > pixel[0] and pixel[1] > pixel[2]


class Render(CommandTest):
    def setUp(self):
        super().setUp()
        self.picture = self.out / "picture.png"

    def command(self, subject, flags):
        size = DRAFT if "--size" in flags else SMALL
        return ("render", subject, *size, "-o", self.picture, *flags)

    def render(self, *flags, subject=ASH, **options):
        return self.succeed(*self.command(subject, flags), **options)

    def pixels(self, *flags, **options):
        self.render(*flags, **options)
        return png.pixels(self.picture.read_bytes())

    def bytes(self, *flags, **options):
        self.render(*flags, **options)
        return self.picture.read_bytes()

    def refuse(self, words, *flags, code=2, subject=ASH, **options):
        self.fail_with(code, words, *self.command(subject, flags), **options)

    def camera(self, **camera):
        return self.input("camera.json", json.dumps(camera).encode())

    def bounds(self):
        box = json.loads(self.succeed("inspect", ASH, "--json").stdout)["leaves"]["bounds"]
        return box["low"], box["high"]
