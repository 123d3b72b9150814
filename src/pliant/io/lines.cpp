#include "pliant/io/lines.h"

#include "pliant/io/number_text.h"

namespace pliant::io {

std::size_t line_end(std::string_view text, std::size_t at, bool last) {
  for (; at < text.size(); ++at) {
    if (text[at] == '\n') {
      return at + 1;
    }
    if (text[at] != '\r') {
      continue;
    }
    if (at + 1 < text.size()) {
      return text[at + 1] == '\n' ? at + 2 : at + 1;
    }
    break;  // whether a \n follows is not known yet
  }
  return last ? text.size() : std::string_view::npos;
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::string_view next_word(std::string_view text, std::size_t& at) {
  const auto blank = [text](std::size_t i) {
    if (is_blank(text[i])) {
      return true;
    }
    return text[i] == '\\' && (i + 1 == text.size() || text[i + 1] == '\n' || text[i + 1] == '\r');
  };
  while (at < text.size() && blank(at)) {
    ++at;
  }
  const std::size_t first = at;
  while (at < text.size() && !blank(at)) {
    ++at;
  }
  return text.substr(first, at - first);
}

std::string quoted(std::string_view word) {
  std::string text = "\"" + std::string(word.substr(0, 40));
  for (char& c : text) {
    if (c < ' ' || c > '~') {
      c = '?';
    }
  }
  return text + (word.size() > 40 ? "...\"" : "\"");
}

std::size_t LineScanner::record_end(std::string_view text, std::size_t at, bool last, std::uint64_t& lines) const {
  std::size_t end = line_end(text, at, last);
  for (lines = 1; end != std::string_view::npos && continues(text.substr(at, end - at)); ++lines) {
    if (end == text.size()) {
      return last ? end : std::string_view::npos;
    }
    end = line_end(text, end, last);
  }
  return end;
}

Result<std::size_t> LineScanner::scan(std::string_view input, bool last, Draft& draft) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::size_t at = 0;
  while (at < input.size() && !draft.full()) {
    std::uint64_t lines = 0;
    const std::size_t end = record_end(input, at, last, lines);
    if (end == std::string_view::npos) {
      break;
    }
    std::string_view line = input.substr(at, end - at);
    if (at_start_ && line.starts_with(byte_order_mark)) {
      draft.keep(byte_order_mark);
      line.remove_prefix(byte_order_mark.size());
    }
    at_start_ = false;
    Status status = scan_line(line, draft);
    if (!status.ok()) {
      return status;
    }
    line_ += lines;
    at = end;
  }
  return at;
}

bool TextScanner::read_color(std::string_view words, double (&rgb)[3]) {
  std::size_t at = 0;
  std::size_t count = 0;
  bool bytes = false;
  for (std::string_view word = next_word(words, at); !word.empty(); word = next_word(words, at), ++count) {
    const std::optional<double> value = read_number(word);
    if (!value || count == 4) {
      return false;
    }
    if (count < 3) {
      rgb[count] = *value;
      bytes = bytes || *value > 1.0;
    }
  }
  for (double& channel : rgb) {
    channel /= bytes ? 255.0 : 1.0;
  }
  return count >= 3;
}

Status TextScanner::take_point(std::string_view line, std::size_t& kept, std::size_t& at, Draft& draft) {
  constexpr const char* axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = next_word(line, at);
    if (word.empty()) {
      return failure({"expected 3 coordinates, found ", axis});
    }
    const std::optional<double> value = read_number(word);
    if (!value) {
      return failure({axes[axis], " is ", quoted(word), "; expected a finite decimal number"});
    }
    if (!draft.admits(*value)) {
      return too_far(*value, draft);
    }
    draft.keep(line.substr(kept, at - word.size() - kept));
    draft.coordinate(*value);
    kept = at;
  }
  ++vertices_;
  return {};
}

}  // namespace pliant::io
