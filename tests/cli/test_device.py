# SPDX-License-Identifier: Apache-2.0
import json

from command import CommandTest


class Devices(CommandTest):
    def setUp(self):
        super().setUp()
        vendors = self.folder / "vendors"
        vendors.mkdir()
        self.none = {"OCL_ICD_VENDORS": str(vendors)}

    def test_one_is_chosen(self):
        devices = json.loads(self.succeed("devices", "--json").stdout)["devices"]
        self.assertEqual([device["index"] for device in devices], list(range(len(devices))))
        chosen = [device for device in devices if device["chosen"]]
        self.assertEqual(len(chosen), 1)
        self.assertTrue(chosen[0]["usable"])
        self.assertIn(chosen[0]["variant"], ("vector", "work-item"))
        self.assertTrue(chosen[0]["reason"])

    def test_table_says_the_same(self):
        devices = json.loads(self.succeed("devices", "--json").stdout)["devices"]
        lines = self.succeed("devices").stdout.splitlines()
        self.assertEqual(len(lines), 1 + len(devices))
        for device, line in zip(devices, lines[1:]):
            self.assertIn(device["name"], line)
            self.assertIn(device["reason"], line)

    def test_chosen_by_index_and_by_name(self):
        devices = json.loads(self.succeed("devices", "--json").stdout)["devices"]
        for choice in ("0", devices[0]["name"][2:10]):
            page = json.loads(self.succeed("devices", "--json", "--device", choice).stdout)
            self.assertTrue(page["devices"][0]["chosen"])

    def test_no_such_device(self):
        for choice in ("99", "no such device"):
            self.fail_with(
                4, [choice], "extract", self.tree, "-o", self.shape, "--device", choice
            )
            self.fail_with(4, [choice], "devices", "--device", choice)

    def test_no_platform_says_how_to_install_one(self):
        command = ("extract", self.tree, "-o", self.shape)
        self.fail_with(4, ["pocl-opencl-icd"], *command, env=self.none)
        self.fail_with(4, ["pocl-opencl-icd"], "devices", env=self.none)

    def test_no_platform_as_json(self):
        result = self.fail_with(4, ["pocl-opencl-icd"], "devices", "--json", env=self.none)
        self.assertEqual(json.loads(result.stdout), {"devices": []})

    def test_an_error_in_the_input_comes_first(self):
        missing = self.folder / "missing.glb"
        command = ("extract", missing, "-o", self.shape)
        self.fail_with(3, ["missing.glb"], *command)
        self.fail_with(3, ["missing.glb"], *command, "--device", "no such device")
        self.fail_with(3, ["missing.glb"], *command, env=self.none)
        leafless = ("extract", self.tree, "-o", self.shape, "--leaves", "nothing")
        self.fail_with(3, ["--leaves"], *leafless, env=self.none)

    def test_one_thread_opens_it_too(self):
        self.succeed("extract", self.tree, "-o", self.shape, "--preset", "draft", "--threads", "1")
