"""blender -b --factory-startup --python trace.py -- HDR OUT SAMPLES SIZE NAME=FILE..

Traces each FILE (.gltf, .glb) with Cycles in the light of HDR, from the camera of OUT/NAME.camera (options of gnomon). Writes
OUT/NAME-trace-0.pfm and -1.pfm, with two seeds, linear, times the alpha; and OUT/NAME-trace-alpha.pfm. No clip, light or camera of
the file; materials as glTF has them, which Blender's Principled is not: see plain()."""
import math
import os
import sys

import numpy as np
np.bool = bool  # the importer of Blender 3.4 names it
import addon_utils
import bpy
from mathutils import Matrix, Vector

hdr, out, samples, size, *models = sys.argv[sys.argv.index('--') + 1:]
width, height = map(int, size.split('x'))
addon_utils.enable('io_scene_gltf2')
addon_utils.enable('cycles')


def blender_from_gltf(x, y, z):
    return Vector((x, -z, y))  # y is up in glTF, z in Blender


def put_camera(scene, options):
    words = options.split()
    given = dict(zip(words[::2], words[1::2]))
    theta, phi, fov = (math.radians(float(given['--camera-' + name])) for name in ('theta', 'phi', 'fov'))
    distance = float(given['--camera-distance'])
    target = blender_from_gltf(*map(float, given['--camera-target'].split(',')))
    back = blender_from_gltf(math.sin(phi) * math.sin(theta), math.cos(phi), math.sin(phi) * math.cos(theta))
    right = Vector((0, 0, 1)).cross(back).normalized()
    data = bpy.data.cameras.new('camera')
    data.sensor_fit = 'VERTICAL'
    data.lens = data.sensor_height / (2 * math.tan(fov / 2))
    data.clip_start, data.clip_end = distance / 1000, distance * 1000
    camera = bpy.data.objects.new('camera', data)
    camera.matrix_world = Matrix.Translation(target + distance * back) @ Matrix((right, back.cross(right), back)).transposed().to_4x4()
    scene.collection.objects.link(camera)
    scene.camera = camera


def put_light(scene):
    scene.world = bpy.data.worlds.new('world')
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    picture = tree.nodes.new('ShaderNodeTexEnvironment')
    picture.image = bpy.data.images.load(hdr)
    spaces = picture.image.colorspace_settings.bl_rna.properties['name'].enum_items.keys()
    picture.image.colorspace_settings.name = 'Linear Rec.709' if 'Linear Rec.709' in spaces else 'Linear'
    tree.links.new(picture.outputs['Color'], tree.nodes['Background'].inputs['Color'])
    scene.world.cycles.sampling_method, scene.world.cycles.sample_map_resolution = 'MANUAL', 1024


# inputs of Principled in Blender 3 and 4
NEW_NAMES = {'Transmission': 'Transmission Weight', 'Clearcoat': 'Coat Weight', 'Clearcoat Roughness': 'Coat Roughness',
             'Emission': 'Emission Color'}


def of(node, name):
    return node.inputs[name if name in node.inputs else NEW_NAMES[name]]


def follow(tree, source, target):
    """Target gets what source gets: a link or a value."""
    if source.links:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def unlink(tree, socket, value):
    for link in list(socket.links):
        tree.links.remove(link)
    socket.default_value = value


def plain(tree, node):
    """The surface of glTF: a Lambert part, less the 4 % that is reflected, beside Principled's reflections of a dielectric; metal
    with its multiple scattering. Principled's diffuse part is Disney's, up to 17 % brighter. Returns the output to be used."""
    transmission = of(node, 'Transmission')
    if transmission.links or transmission.default_value > 0:
        return node.outputs[0]
    new = lambda kind: tree.nodes.new('ShaderNode' + kind)
    users = [link.to_socket for link in node.outputs[0].links]
    lambert, less, dielectric, metal, surface = new('BsdfDiffuse'), new('MixRGB'), new('AddShader'), new('BsdfPrincipled'), new('MixShader')
    less.blend_type, less.inputs[0].default_value, less.inputs[2].default_value = 'MULTIPLY', 1, (.96, .96, .96, 1)
    follow(tree, node.inputs['Base Color'], less.inputs[1])
    tree.links.new(less.outputs[0], lambert.inputs['Color'])
    follow(tree, node.inputs['Normal'], lambert.inputs['Normal'])
    metal.distribution, metal.inputs['Metallic'].default_value = 'MULTI_GGX', 1
    for name in ('Base Color', 'Roughness', 'Normal'):
        follow(tree, node.inputs[name], metal.inputs[name])
    node.distribution = 'GGX'
    follow(tree, node.inputs['Metallic'], surface.inputs[0])
    emission, glowing, clear, whole = new('Emission'), new('AddShader'), new('BsdfTransparent'), new('MixShader')
    follow(tree, of(node, 'Emission'), emission.inputs['Color'])
    follow(tree, node.inputs['Emission Strength'], emission.inputs['Strength'])
    follow(tree, node.inputs['Alpha'], whole.inputs[0])
    unlink(tree, node.inputs['Base Color'], (0, 0, 0, 1))
    unlink(tree, node.inputs['Metallic'], 0)
    unlink(tree, of(node, 'Emission'), (0, 0, 0, 1))
    unlink(tree, node.inputs['Alpha'], 1)
    for source, target in ((lambert, dielectric.inputs[0]), (node, dielectric.inputs[1]), (dielectric, surface.inputs[1]),
                           (metal, surface.inputs[2]), (surface, glowing.inputs[0]), (emission, glowing.inputs[1]),
                           (clear, whole.inputs[1]), (glowing, whole.inputs[2])):
        tree.links.new(source.outputs[0], target)
    for target in users:
        tree.links.new(whole.outputs[0], target)
    return whole.outputs[0]


def coat(tree, node, whole):
    """A coat of the Fresnel reflection of 1.5 over all; Blender 3.4 has a quarter of that."""
    amount = of(node, 'Clearcoat')
    if not amount.links and amount.default_value <= 0:
        return
    mix, gloss, fresnel, share = (tree.nodes.new('ShaderNode' + kind) for kind in ('MixShader', 'BsdfGlossy', 'Fresnel', 'Math'))
    share.operation, fresnel.inputs['IOR'].default_value = 'MULTIPLY', 1.5
    users = [link.to_socket for link in whole.links]
    tree.links.new(fresnel.outputs[0], share.inputs[0])
    follow(tree, amount, share.inputs[1])
    follow(tree, of(node, 'Clearcoat Roughness'), gloss.inputs['Roughness'])
    unlink(tree, amount, 0)
    tree.links.new(share.outputs[0], mix.inputs[0])
    tree.links.new(whole, mix.inputs[1])
    tree.links.new(gloss.outputs[0], mix.inputs[2])
    for target in users:
        tree.links.new(mix.outputs[0], target)


def cull(tree, output):
    """Backs of single-sided faces are not seen, but cast and reflect."""
    path, geometry, both, clear, mix = (tree.nodes.new('ShaderNode' + kind) for kind in
                                        ('LightPath', 'NewGeometry', 'Math', 'BsdfTransparent', 'MixShader'))
    both.operation = 'MULTIPLY'
    tree.links.new(path.outputs['Is Camera Ray'], both.inputs[0])
    tree.links.new(geometry.outputs['Backfacing'], both.inputs[1])
    tree.links.new(both.outputs[0], mix.inputs[0])
    tree.links.new(output.inputs['Surface'].links[0].from_socket, mix.inputs[1])
    tree.links.new(clear.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs['Surface'])


def mend(material):
    if not material.use_nodes:
        return
    tree = material.node_tree
    output = next((node for node in tree.nodes if node.type == 'OUTPUT_MATERIAL'), None)
    if output is None or not output.inputs['Surface'].links:
        return
    for node in [node for node in tree.nodes if node.type == 'BSDF_PRINCIPLED']:
        node.distribution = 'MULTI_GGX'
        coat(tree, node, plain(tree, node))
    if material.use_backface_culling:
        cull(tree, output)


def set_up(name, file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.import_scene.gltf(filepath=file)
    for thing in list(scene.objects):
        thing.animation_data_clear()
        if thing.type == 'ARMATURE':
            thing.data.pose_position = 'REST'
        if thing.type in ('LIGHT', 'CAMERA'):
            bpy.data.objects.remove(thing)
    for collection in bpy.data.collections:
        if collection.name.startswith('glTF_not_exported'):  # the importer's own shapes of bones
            for thing in collection.objects:
                thing.hide_render = True
    for material in bpy.data.materials:
        mend(material)
    with open(os.path.join(out, name + '.camera'), encoding='ascii') as file_of_camera:
        put_camera(scene, file_of_camera.read())
    put_light(scene)
    return scene


def set_renderer(scene):
    render, cycles = scene.render, scene.cycles
    render.engine, render.film_transparent = 'CYCLES', True
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.image_settings.file_format, render.image_settings.color_depth = 'OPEN_EXR', '32'
    render.image_settings.color_mode = 'RGBA'
    scene.view_settings.view_transform, scene.view_settings.look = 'Standard', 'None'
    cycles.device, cycles.use_denoising, cycles.use_adaptive_sampling = 'CPU', False, False
    cycles.samples, cycles.max_bounces = int(samples), 8
    cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 8
    cycles.transparent_max_bounces = 32
    cycles.pixel_filter_type, cycles.filter_width = 'BOX', 1.0  # as many samples of a pixel are
    cycles.sample_clamp_indirect = cycles.sample_clamp_direct = cycles.blur_glossy = 0
    cycles.film_transparent_glass, cycles.film_transparent_roughness = True, 1  # what is behind glass is not in the picture


def write_pfm(path, pixels):
    with open(path, 'wb') as file:
        file.write(b'%s\n%d %d\n-1\n' % (b'PF' if pixels.ndim == 3 else b'Pf', width, height))
        file.write(np.ascontiguousarray(pixels, '<f4').tobytes())  # the lowest row first, as Blender has it


def trace(scene, seed):
    path = os.path.join(out, 'trace-%d.exr' % os.getpid())
    scene.cycles.seed, scene.render.filepath = seed, path
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(path, check_existing=False)
    pixels = np.empty(width * height * 4, np.float32)
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    os.remove(path)
    return pixels.reshape(height, width, 4)


for model in models:
    name, file = model.split('=', 1)
    scene = set_up(name, file)
    set_renderer(scene)
    for seed in (0, 1):
        pixels = trace(scene, seed)
        write_pfm(os.path.join(out, '%s-trace-%d.pfm' % (name, seed)), pixels[..., :3])
    write_pfm(os.path.join(out, name + '-trace-alpha.pfm'), pixels[..., 3])
    print('TRACED', name, flush=True)
