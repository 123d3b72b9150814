// A file read whole: its points, polygons and texture coordinates, and its bytes, so that it can be
// written again with nothing but the coordinates changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pliant/core/status.h"
#include "pliant/io/bytes.h"
#include "pliant/io/format.h"
#include "pliant/io/polygon_mesh.h"

namespace pliant::io {

class Document {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{384} << 20;
  static constexpr std::size_t kPieceSize = std::size_t{1} << 20;

  Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Reads a file. After an error the document is what it was before.
  /// Errors: parse_error (line or byte, and the reason), too_large (`kMaxBytes`, or more vertices,
  /// corners or texture coordinates than Shape and PolygonCollector admit).
  Status read(FileFormat format, Bytes bytes);

  /// The same in pieces, for those who want to know how far it is, or to stop: begin, then advance until it returns 1.
  /// Until then, and after an error, the document is what it was before.
  Status begin(FileFormat format, Bytes bytes);
  /// Reads about `kPieceSize` bytes further. Returns the fraction of the file that has been read.
  Result<double> advance();

  /// Takes a shape from elsewhere instead of a file. positions: 3 n. polygons: for each one the
  /// number of its corners, at least 3, and their vertex ids. After an error the document is what
  /// it was before. Errors: invalid_shape, too_large.
  Status assign(std::span<const double> positions, std::span<const std::int32_t> polygons);
  /// 2 numbers a corner, in the order of the polygons. To be called after assign or read.
  /// Errors: invalid_shape.
  Status assign_texcoords(std::span<const double> texcoords);
  /// 3 bytes a vertex: red, green, blue in sRGB. To be called after assign or read. Errors: invalid_shape.
  Status assign_colors(std::span<const std::uint8_t> colors);

  const PolygonMesh& mesh() const { return mesh_; }
  /// The polygons as triangles (triangulate.h), 3 m vertex ids.
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }

  /// The file with new positions, 3 n. In the format it was read from: the same bytes except what
  /// rewriter.h says. In another format: positions, polygons and texture coordinates, as far as the
  /// format has room for them. Errors: invalid_shape (nothing was read, the number of positions,
  /// one that is not finite or does not fit, no faces for STL), too_large (memory).
  Result<Bytes> write(FileFormat format, std::span<const double> positions) const;

 private:
  struct Reading;

  Status finish_reading();
  Result<Bytes> rewrite(std::span<const double> positions) const;
  Result<Bytes> convert(FileFormat format, std::span<const double> positions) const;

  Bytes source_;  ///< empty after assign
  FileFormat format_ = FileFormat::obj;
  PolygonMesh mesh_;
  std::vector<std::uint32_t> triangles_;
  std::unique_ptr<Reading> reading_;  ///< between begin and the end of the file
};

}  // namespace pliant::io
