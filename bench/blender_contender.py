# SPDX-License-Identifier: Apache-2.0
"""Blender's Points to Volume, then Volume to Mesh, at a case's radius and voxel size. It runs
inside Blender: blender --background --factory-startup --python blender_contender.py -- CASE.json

Two objects, so that the two nodes can be timed apart: the mesh object's nodes take the volume
object's evaluated geometry. Blender fills a fog volume around the points as spheres; its surface
is where the fog is at the node's own threshold."""

import json
import sys
import time
from pathlib import Path

import bpy
import numpy


def report(values: dict) -> None:
    print(json.dumps(values), flush=True)


def point_cloud(path: str) -> bpy.types.Mesh:
    points = numpy.fromfile(path, "<f8").astype("f4")
    mesh = bpy.data.meshes.new("points")
    mesh.vertices.add(len(points) // 3)
    mesh.vertices.foreach_set("co", points)
    mesh.update()
    return mesh


def add_object(name: str, mesh: bpy.types.Mesh, nodes: bpy.types.NodeTree) -> bpy.types.Object:
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    thing.modifiers.new("nodes", "NODES").node_group = nodes
    return thing


def new_nodes(name: str) -> bpy.types.NodeTree:
    nodes = bpy.data.node_groups.new(name, "GeometryNodeTree")
    nodes.inputs.new("NodeSocketGeometry", "Geometry")
    nodes.outputs.new("NodeSocketGeometry", "Geometry")
    return nodes


def points_to_volume(radius: float, voxel: float) -> bpy.types.NodeTree:
    nodes = new_nodes("points to volume")
    volume = nodes.nodes.new("GeometryNodePointsToVolume")
    volume.resolution_mode = "VOXEL_SIZE"
    volume.inputs["Voxel Size"].default_value = voxel
    volume.inputs["Radius"].default_value = radius
    source = nodes.nodes.new("NodeGroupInput")
    result = nodes.nodes.new("NodeGroupOutput")
    nodes.links.new(source.outputs[0], volume.inputs["Points"])
    nodes.links.new(volume.outputs["Volume"], result.inputs[0])
    return nodes


def volume_to_mesh(source: bpy.types.Object) -> bpy.types.NodeTree:
    nodes = new_nodes("volume to mesh")
    info = nodes.nodes.new("GeometryNodeObjectInfo")
    info.inputs["Object"].default_value = source
    mesh = nodes.nodes.new("GeometryNodeVolumeToMesh")
    mesh.resolution_mode = "GRID"
    result = nodes.nodes.new("NodeGroupOutput")
    nodes.links.new(info.outputs["Geometry"], mesh.inputs["Volume"])
    nodes.links.new(mesh.outputs["Mesh"], result.inputs[0])
    return nodes


def evaluate() -> float:
    start = time.perf_counter()
    bpy.context.view_layer.update()
    return time.perf_counter() - start


class Pipeline:
    def __init__(self, case: dict) -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        cloud = point_cloud(case["points"])
        nodes = points_to_volume(case["radius"], case["voxel"])
        self.volume = add_object("volume", cloud, nodes)
        empty = bpy.data.meshes.new("empty")
        self.mesh = add_object("mesh", empty, volume_to_mesh(self.volume))
        self.volume.modifiers[0].show_viewport = False
        self.mesh.modifiers[0].show_viewport = False
        evaluate()

    def run(self) -> dict:
        self.volume.modifiers[0].show_viewport = True
        field = evaluate()
        self.mesh.modifiers[0].show_viewport = True
        mesh = evaluate()
        surface = self.mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        counts = {"vertices": len(surface.vertices), "faces": len(surface.polygons)}
        self.volume.modifiers[0].show_viewport = False
        self.mesh.modifiers[0].show_viewport = False
        evaluate()
        return {"field": field, "mesh": mesh, "total": field + mesh, **counts}


def main() -> None:
    case = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    pipeline = Pipeline(case)
    report({"ready": True, "name": "blender", "version": bpy.app.version_string, "setup": {}})
    for line in sys.stdin:
        if line.strip() != "run":
            break
        report(pipeline.run())


main()
