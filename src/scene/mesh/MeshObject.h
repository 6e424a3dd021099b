// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "input/ReadScope.h"

namespace allpairs::scene {

using Point = std::array<double, 3>;

/// One object of a mesh file, or one node that shows a mesh, where it lies in the world.
struct MeshObject {
  std::string name;    ///< As in the file, with nodes that it is in where that takes to tell it apart; may be empty.
  std::string kind{};  ///< "IfcColumn", where the format has classes of objects.
  std::string id{};    ///< What identifies it for good, where the format has such: an IFC's GlobalId.
  std::string
      body{};  ///< What it is a part of: objects of the same, which has this name alone in the file, are one body.
  std::string assembly{};    ///< Likewise what it and other bodies are parts of.
  std::string assemblyId{};  ///< What identifies that for good.
  std::string path{};        ///< Where it is among nested objects, as of ModelSource.
  std::string passedOver{};  ///< What of it is not read, as a remark says it; empty where all is.
  std::vector<Point> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 2>> lines;
  std::vector<std::uint32_t> points;

  [[nodiscard]] bool hasElements() const { return !triangles.empty() || !lines.empty() || !points.empty(); }

  /// Shows all positions as points, from a place in the list on.
  void addAllPoints(std::size_t from = 0) {
    for (std::size_t i = from; i < positions.size(); ++i) points.push_back(static_cast<std::uint32_t>(i));
  }
};

/// What a format says of coordinates besides; nothing where it says nothing.
struct MeshFrame {
  int up = 0;                  ///< The axis that points up: 1 to 3 for x to z.
  double metresPerUnit = 0.0;  ///< 0: unknown.
};

/// What a user should know of a file that was read, as a warning of a scene says it.
struct FileWarning {
  std::string subject;
  std::string reason;
};

/// What a reader says of a file besides its objects.
struct FileNotes {
  MeshFrame frame;
  std::vector<std::string> passedOver;  ///< For remarks.
  std::vector<FileWarning> warnings;
};

/// Reads a Wavefront file in double, with the names exactly as they stand there: an object for each "o", or for each
/// "g" where there is no "o". A file of nothing but positions is one object of points.
///
/// Bad input: throws FileError with its line.
[[nodiscard]] std::vector<MeshObject> readObjObjects(const std::filesystem::path& path, ReadScope& scope);

/// Reads a Stanford file, ASCII or binary of either byte order, in double: its faces, or its vertices as points where
/// it has no faces.
///
/// Bad input: throws FileError. Nothing is allocated for elements that a header only claims.
[[nodiscard]] std::vector<MeshObject> readPlyObjects(const std::filesystem::path& path, ReadScope& scope);

/// Reads an OFF file in double, with what precedes its first word: COFF, NOFF and the like. Without faces its vertices
/// are points.
///
/// Bad input: throws FileError with its line. Nothing is allocated for what a header only claims.
[[nodiscard]] std::vector<MeshObject> readOffObjects(const std::filesystem::path& path, ReadScope& scope);

/// Reads an STL file: binary, or as text in double with an object for each solid, under its whole name.
///
/// Bad input: throws FileError, with its line where it is text; a file that ends early too.
[[nodiscard]] std::vector<MeshObject> readStlObjects(const std::filesystem::path& path, ReadScope& scope);

/// Reads a glTF 2.0 file, as JSON or GLB: an object for each node of its scene that shows a mesh, with the node's
/// transform applied in double. Skins and morph targets are passed over, with a remark of the object; animations and
/// other scenes too, with a note.
///
/// Bad input: throws FileError; so do a node with two parents and a mesh that is compressed.
[[nodiscard]] std::vector<MeshObject> readGltfObjects(const std::filesystem::path& path, ReadScope& scope,
                                                      FileNotes& notes);

/// Reads a drawing as text (DXF) in double: an object for each layer, of the lines, polylines, faces, polyface and
/// polygon meshes, solids, traces and points of the model space, with the blocks in their places. What a block has in
/// layer 0 is in the layer in which it is inserted. Arcs and other curves are missing, with a warning, as are blocks of
/// other drawings; the paper space and hidden entities are passed over, with a note. Texts, dimensions and pictures are
/// no shapes.
///
/// Bad input: throws FileError with its line; so do binary files, and solids, surfaces and meshes of other kinds.
/// Reference: AutoCAD 2012 DXF Reference, "ENTITIES Section" and "BLOCKS Section".
[[nodiscard]] std::vector<MeshObject> readDxfObjects(const std::filesystem::path& path, ReadScope& scope,
                                                     FileNotes& notes);

/// Reads what else Assimp reads: an object for each node that shows a mesh, with the node's transform applied in double
/// to positions that Assimp gives as float32. Coordinates are those of the file: what Assimp does to turn y up and to
/// measure in metres, as for IFC, is undone, and the notes say which axis is up in the file and how long its unit is.
/// Warnings say which shapes of an IFC or an X3D Assimp does not read, what of an IFC it puts elsewhere, and how
/// coordinates far from the origin are rounded.
///
/// Bad input: throws FileError. Assimp runs in a process of its own: a file that makes it fail, or loop, or take all
///            memory, fails, loops and takes it there.
[[nodiscard]] std::vector<MeshObject> readAssimpObjects(const std::filesystem::path& path, ReadScope& scope,
                                                        FileNotes& notes);

/// Why a file is not read that by its extension has shapes, such as one of a CAD program's exact surfaces; empty for
/// others.
[[nodiscard]] std::string_view whyNotRead(const std::filesystem::path& path);

/// Whether Assimp knows files of this extension, and reads shapes from them.
[[nodiscard]] bool isAssimpFile(const std::filesystem::path& path);

/// Whether readMesh() takes files of this extension.
[[nodiscard]] bool isMeshFile(const std::filesystem::path& path);

}  // namespace allpairs::scene
