#include "pliant/io/rewriter.h"

#include "pliant/core/message.h"

namespace pliant::io {

std::unique_ptr<Scanner> make_scanner(FileFormat format, PolygonCollector* polygons) {
  switch (format) {
    case FileFormat::obj:
      return make_obj_scanner(polygons);
    case FileFormat::ply:
      return make_ply_scanner(polygons);
    case FileFormat::off:
      return make_off_scanner(polygons);
    case FileFormat::stl:
      return make_stl_scanner(polygons);
    case FileFormat::xyz:
      return make_xyz_scanner();
  }
  return nullptr;
}

void Rewriter::open(FileFormat format, const DraftOptions& options) {
  scanner_ = make_scanner(format, nullptr);
  pending_.clear();
  draft_ = Draft({.largest = options.largest, .normals = options.normals});
  state_ = State::pushing;
}

Status Rewriter::push(ByteView piece, bool last) {
  if (state_ != State::pushing) {
    const char* reason =
        state_ == State::closed ? "push without an open file" : "push before the last piece was emitted";
    return {ErrorCode::invalid_option, reason};
  }
  draft_.clear();
  pending_.insert(pending_.end(), piece.begin(), piece.end());
  Status status = scan(last);
  if (!status.ok()) {
    draft_.clear();
    state_ = State::closed;
    return status;
  }
  state_ = last ? State::emitting_last : State::emitting;
  return {};
}

Status Rewriter::scan(bool last) {
  const Result<std::size_t> taken = scanner_->scan(text_of(pending_), last, draft_);
  if (!taken.ok()) {
    return taken.status();
  }
  pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(*taken));
  if (last) {
    return scanner_->finish();
  }
  if (pending_.size() <= kMaxRecord) {
    return {};
  }
  return {ErrorCode::parse_error, message({scanner_->place(), ": a record of more than ", kMaxRecord, " bytes"})};
}

Status Rewriter::emit(std::span<const double> coordinates, std::span<const double> normals, Bytes& out) {
  if (state_ != State::emitting && state_ != State::emitting_last) {
    return {ErrorCode::invalid_option, "emit without a push before it"};
  }
  const std::size_t size_before = out.size();
  Status status = draft_.emit(coordinates, normals, out);
  if (!status.ok()) {
    out.resize(size_before);
    return status;
  }
  state_ = state_ == State::emitting_last ? State::closed : State::pushing;
  return {};
}

}  // namespace pliant::io
