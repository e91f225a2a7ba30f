// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "studio/views.h"

/// Binary frames of the protocol, little-endian: "CRM1", the length of the header as uint32, the header (JSON, padded
/// with blanks so that it ends at a multiple of 8), then blocks of numbers. The header names a block as [byte, count]:
/// its first byte, counted from the end of the header and a multiple of 8, and how many rows it has.
///
/// `members` are those of the header that its sender knows ("re", "gesture", ...): the text of a JSON object. The
/// functions throw InputError for one that is none or has members of theirs.
namespace carom::studio {

/// Type "motion": scene, end, status, message, gravity, count (of bodies), impacts [{t, point, bodies, nth, pairs, mode}] and tracks
/// [{body, arcs, stride, turns, center}]. Rows of `arcs` are float64 [t, position, velocity, acceleration], 10 numbers;
/// where the track has a `stride` of 19, followed by [third, fourth, fifth]. Rows of `turns` are float32
/// [t, w, x, y, z]. See DisplayTrack. Tracks that equal those of `sent`, which the reader has, are left out where that
/// was of the same scene.
std::string motionFrame(const MotionView& view, std::string_view members = "{}", const MotionView* sent = nullptr);

/// Type "alternative": the same of another motion, with all its tracks.
std::string alternativeFrame(const MotionView& view, std::string_view members = "{}");

/// Type "scene": scene (its number), count (bodies that the scene has), extent {min, max} and bodies [{body, name,
/// fixed, colour, center, radius, pose {position, orientation}, and either plane {normal, offset} or vertices, normals,
/// triangles, accent}],
/// where rows of `vertices` and `normals` are float32 [x, y, z] and those of `triangles` and `accent` uint32, three
/// vertices each. Equal meshes share their blocks. Bodies that look like those of `sent` are left out where that was the
/// same scene.
std::string sceneFrame(const SceneView& view, std::string_view members = "{}", const SceneView* sent = nullptr);

/// Type "exported": name, size and, right behind the header, the bytes of a file.
std::string fileFrame(const std::string& name, std::string_view bytes, std::string_view members = "{}");

}  // namespace carom::studio
