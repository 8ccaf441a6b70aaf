# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""A URDF's links stand where MuJoCo puts them; bad files are refused with the reason."""

from pathlib import Path

from grasp_quality_hand.fetch_dclaw import dclaw_directory, URDF
from grasp_quality_hand.grasp_objects import OBJECTS
from grasp_quality_hand.hand_model import build_hand_model
from grasp_quality_hand.urdf_shapes import coarse, link_meshes, mesh_of
from grasp_quality_hand.urdf_tree import mesh_file, read_urdf, Shape, UrdfError
import mujoco
import numpy as np
import pytest
import trimesh

ONE_JOINT = """<robot name="arm">
<link name="base"/><link name="tip"><visual>
<origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><geometry><box size="1 2 3"/></geometry>
</visual></link><link name="end"/>
<joint name="grip" type="fixed"><parent link="tip"/><child link="end"/></joint>
<joint name="bend" type="{kind}"><origin xyz="1 0 0"/><parent link="{parent}"/>
<child link="tip"/><axis xyz="0 0 2"/></joint></robot>"""
FOLDER = Path('.')


def test_links_stand_where_mujoco_puts_them():
    folder = dclaw_directory()
    tree = read_urdf((folder / URDF).read_text(), folder)
    hand = build_hand_model(OBJECTS['cube'])
    data = mujoco.MjData(hand.mujoco)
    for seed in range(5):
        angles = np.random.default_rng(seed).uniform(-0.5, 1.0, 9)
        data.qpos[hand.joint_qpos] = angles
        mujoco.mj_kinematics(hand.mujoco, data)
        poses = tree.link_poses(dict(zip(hand.joint_names, angles)))
        for body in hand.tip_bodies:
            pose = poses[hand.mujoco.body(body).name]
            np.testing.assert_allclose(pose[:3, 3], data.xpos[body], atol=1e-12)
            np.testing.assert_allclose(pose[:3, :3].ravel(), data.xmat[body], atol=1e-12)


def test_every_link_of_the_hand_is_drawn_with_a_few_thousand_triangles():
    folder = dclaw_directory()
    tree = read_urdf((folder / URDF).read_text(), folder)
    count = {link: sum(len(mesh.faces) for mesh in link_meshes(tree, link))
             for link in tree.visual}
    drawn = {link for link, faces in count.items() if faces}
    assert drawn == {'base_link'} | {f'link_f{f}_{j}' for f in (1, 2, 3) for j in (1, 2, 3)}
    assert sum(count.values()) < 60_000


@pytest.mark.parametrize('kind, value, corner', [
    ('revolute', np.pi / 2, [1.0, 1.0, 0.0]), ('prismatic', 0.5, [2.0, 0.0, 0.5]),
    ('fixed', 0.5, [2.0, 0.0, 0.0])])
def test_joints_move_about_and_along_their_axis(kind, value, corner):
    tree = read_urdf(ONE_JOINT.format(kind=kind, parent='base'), FOLDER)
    pose = tree.link_poses({'bend': value})['end']
    np.testing.assert_allclose(pose @ [1.0, 0.0, 0.0, 1.0], [*corner, 1.0], atol=1e-12)


def test_a_joint_may_mimic_another():
    text = ONE_JOINT.format(kind='prismatic', parent='base').replace(
        '<axis', '<mimic joint="other" multiplier="-2" offset="0.1"/><axis')
    pose = read_urdf(text, FOLDER).link_poses({'other': 0.3, 'bend': 9.0})['tip']
    np.testing.assert_allclose(pose[:3, 3], [1.0, 0.0, -0.5], atol=1e-12)


def test_a_shape_stands_in_the_frame_of_its_link():
    tree = read_urdf(ONE_JOINT.format(kind='fixed', parent='base'), FOLDER)
    mesh, = link_meshes(tree, 'tip')
    np.testing.assert_allclose(mesh.bounds, [[-1.0, -0.5, -0.5], [1.0, 0.5, 2.5]], atol=1e-12)
    for kind, size, volume in (('sphere', (2.0,), 4 / 3 * np.pi * 8),
                               ('cylinder', (1.0, 3.0), 3 * np.pi)):
        assert mesh_of(Shape(np.eye(4), kind, size)).volume == pytest.approx(volume, rel=0.06)


def test_a_coarse_mesh_keeps_its_size_and_loses_triangles():
    fine = trimesh.creation.icosphere(subdivisions=5)
    rough = coarse(fine)
    assert len(rough.faces) < 0.6 * len(fine.faces)
    np.testing.assert_allclose(rough.bounds, fine.bounds, atol=0.06)
    assert rough.area == pytest.approx(fine.area, rel=0.05)


@pytest.mark.parametrize('text, words', [
    ('<robot', 'no XML'),
    ('<robot><link name="a"/><link name="b"/></robot>', "has \\['a', 'b'\\]"),
    (ONE_JOINT.format(kind='revolute', parent='nowhere'), "parents are .*'nowhere'"),
    (ONE_JOINT.format(kind='hinge', parent='base'), "got 'hinge'"),
    (ONE_JOINT.format(kind='fixed', parent='base').replace('0 0 2', '0 0'), 'xyz must be three'),
    (ONE_JOINT.format(kind='fixed', parent='base').replace('0 0 2', '0 0 up'),
     'xyz must be three'),
    (ONE_JOINT.format(kind='fixed', parent='base').replace('box', 'torus'), "got 'torus'")])
def test_what_is_no_urdf_is_refused_with_the_reason(text, words):
    with pytest.raises(UrdfError, match=words):
        read_urdf(text, FOLDER)


def test_mesh_files_are_found_or_named(tmp_path):
    assert mesh_file('meshes/a.stl', tmp_path) == tmp_path / 'meshes' / 'a.stl'
    assert mesh_file('file:///there/a.stl', tmp_path) == Path('/there/a.stl')
    assert mesh_file('package://grasp_quality/package.xml', tmp_path).is_file()
    with pytest.raises(UrdfError, match="package 'no_such_hand' is not"):
        mesh_file('package://no_such_hand/a.stl', tmp_path)
    (tmp_path / 'a.stl').write_text('nothing')
    for name in ('a.stl', 'b.stl'):
        with pytest.raises(UrdfError, match=name):
            mesh_of(Shape(np.eye(4), 'mesh', (1.0, 1.0, 1.0), tmp_path / name))
