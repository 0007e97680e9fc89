# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
from .entries.bag_capture import CaptureJob as CaptureJob
from .entries.bag_capture import Saved as Saved
from .entries.bag_capture import Settings as Settings
from .entries.bag_capture import capture_bags as capture_bags
from .entries.take import Cut as Cut
from .entries.take import capture_take as capture_take
from .recordings.pose_file import read_pose_file as read_pose_file
from .recordings.recording import lifted_track as lifted_track
from .recordings.recording import open_recording as open_recording
from .recordings.recording import track_of as track_of
from .recordings.skeleton_bag import read_skeletons as read_skeletons
from .retarget.robot_motion import RobotMotion as RobotMotion
from .retarget.robot_motion import retarget_motion as retarget_motion
from .tracks.signer_motion import SignerMotion as SignerMotion
from .tracks.signer_motion import signer_motion as signer_motion
from .tracks.skeleton_track import SkeletonTrack as SkeletonTrack
