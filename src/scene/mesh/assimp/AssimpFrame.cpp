// SPDX-License-Identifier: MIT
#include "mesh/assimp/AssimpFrame.h"

#include <assimp/scene.h>

#include <array>
#include <cmath>
#include <string_view>

#include "input/Words.h"

namespace allpairs::scene {
namespace {

using Turn = std::array<std::array<int, 3>, 3>;

// What Assimp does to make y point up: a row for each axis of its result.
constexpr Turn kFromZUp{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
constexpr Turn kFromXUp{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};

/// What is left of a number that was whole before it became a float and was turned.
double cleaned(double value) {
  const double whole = std::round(value);
  return std::abs(value - whole) < 1e-6 ? whole : value;
}

/// The length that is one in the file.
double scaleOf(const Transform& root) { return std::hypot(root[0][0], root[1][0], root[2][0]); }

bool isTurn(const Transform& root, double scale, const Turn& turn) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      if (std::abs(root[row][column] / scale - turn[row][column]) > 1e-5) return false;
    }
  }
  return true;
}

/// The transform that comes before a turn and a scale: a turn's inverse is its transpose.
Transform before(const Transform& root, double scale, const Turn& turn) {
  Transform result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += turn[k][row] * root[k][column];
      result[row][column] = column < 3 ? cleaned(sum / scale) : sum / scale;
    }
  }
  return result;
}

/// A float that was written with a few digits, as those digits: 0.001f is 0.001.
double asWritten(double value) {
  const double digits = std::pow(10.0, 6.0 - std::floor(std::log10(value)));
  return std::round(value * digits) / digits;
}

/// What Assimp does to make the coordinates of DirectX right-handed, which takes itself back.
constexpr Transform kMirror{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}}};

int upOfMetadata(const aiScene& scene) {
  int axis = -1;
  if (scene.mMetaData == nullptr || !scene.mMetaData->Get("UpAxis", axis)) return 0;
  return axis >= 0 && axis < 3 ? axis + 1 : 0;
}

/// Whether an FBX says how long its unit is; Assimp says a centimetre where it does not. In binary files a name has its
/// length before it.
bool saysUnit(std::string_view bytes) {
  constexpr std::string_view kName = "UnitScaleFactor";
  for (std::size_t at = bytes.find(kName); at != std::string_view::npos; at = bytes.find(kName, at + 1)) {
    if (at > 0 && (bytes[at - 1] == '"' || bytes[at - 1] == '\0')) return true;  // OriginalUnitScaleFactor is another
  }
  return false;
}

}  // namespace

Transform transformOf(const aiMatrix4x4& matrix) {
  Transform result{};
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) result[row][column] = static_cast<double>(matrix[row][column]);
  }
  return result;
}

Transform rootOfFile(const aiScene& scene, const std::string& extension, MeshFrame& frame) {
  const Transform root = transformOf(scene.mRootNode->mTransformation);
  const double scale = scaleOf(root);
  if (!(scale > 0.0) || !std::isfinite(scale)) return root;
  if (isOneOf(extension, {".ifc", ".ifczip"})) {  // whose placement in the world may turn it too
    frame = {.up = 3, .metresPerUnit = asWritten(scale)};
    return before(root, asWritten(scale), kFromZUp);
  }
  constexpr Turn kNone{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (extension == ".dae") {
    frame = {.up = 2, .metresPerUnit = asWritten(scale)};
    if (isTurn(root, scale, kFromZUp)) frame.up = 3;
    if (isTurn(root, scale, kFromXUp)) frame.up = 1;
    return before(root, asWritten(scale), frame.up == 3 ? kFromZUp : (frame.up == 1 ? kFromXUp : kNone));
  }
  if (isOneOf(extension, {".3ds", ".ase", ".ask", ".blend"})) {  // a 3DS may have a scale besides
    frame.up = 3;
    return isTurn(root, scale, kFromZUp) ? before(root, scale, kFromZUp) : root;
  }
  if (extension == ".x") return multiply(kMirror, root);
  if (extension == ".fbx") frame.up = upOfMetadata(scene);
  if (isOneOf(extension, {".x3d", ".wrl"})) frame.up = 2;
  return root;
}

double unitOfFbx(const aiScene& scene, std::string_view bytes) {
  constexpr double kCentimetre = 0.01;
  float factor = 0.0F;
  if (scene.mMetaData == nullptr || !saysUnit(bytes) || !scene.mMetaData->Get("UnitScaleFactor", factor)) return 0.0;
  const auto written = static_cast<double>(factor);
  return written > 0.0 && std::isfinite(written) ? asWritten(kCentimetre * written) : 0.0;
}

}  // namespace allpairs::scene
