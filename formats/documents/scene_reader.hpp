// SPDX-License-Identifier: MIT
// Private to formats/*.cpp.
#pragma once

#include "formats/base/document.h"
#include "formats/json/json.hpp"

namespace carom::formats_detail {

class SurfaceFiles;

// From a document that follows the schema. Throw InputError for what the schema cannot say.
Document readDocument(const Json& document, const std::string& folder);
Scene readScene(const Json& document, SurfaceFiles& files);
std::vector<Control> readControls(const Json& document, const Scene& scene);
/// The distribution of a control, of which `count` components vary.
Distribution readDistribution(const Json& value, std::size_t count, const std::string& where);
std::vector<Constraint> readConstraints(const Json& document, const Scene& scene, double duration);

/// The folder of a file, never empty.
std::string folderOf(const std::string& path);
/// The member "$schema" for a document in another folder: a file name becomes relative to it, an address stays.
std::string movedSchema(const std::string& schema, const std::string& from, const std::string& to);
/// File names of hulls and meshes become relative to another folder.
void moveFiles(Scene& scene, const std::string& from, const std::string& to);

/// The shape that an object has as one of its members.
Shape readShape(const Json& value, const std::string& where, SurfaceFiles& files);

/// A text that may be missing: then it is empty.
std::string textOr(const Json& object, const char* member);
Vec3 readVector(const Json& value);
/// Unit quaternion from [w, x, y, z]; accepts numbers that were rounded to three digits.
Quat readQuaternion(const Json& value, const std::string& where);
/// Index of the named body of a scene; InputError at `where`, with the names that there are.
int readBodyName(const Json& value, const std::string& where, const Scene& scene);
[[noreturn]] void failUnknownMaterial(const std::string& where, const std::string& name, const Scene& scene);

/// Words of the format for the rules of combination, in the order of Combine.
const std::vector<std::string>& combineWords();

}  // namespace carom::formats_detail
