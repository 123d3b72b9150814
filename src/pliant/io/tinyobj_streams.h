// The few stream operations tinyobjloader uses, without the standard library's streams. Internal to
// obj_faces.cpp, which includes tinyobjloader with `std` standing for this namespace: constructing
// any standard stream sets up the global locale, which brings 85 kB (35 kB gzip) of code for
// dates, money and wide characters into the WASM module. The standard's own headers are included
// here, under their own name, so that tinyobjloader's #includes of them are spent.
#pragma once

#include <cassert>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pliant::io::tinyobj_std {

using namespace ::std;  // containers, strings, numbers; the names declared below come first

/// Characters to read, from first to last.
class streambuf {
 public:
  streambuf(const char* first, const char* last) : at_(first), last_(last) {}
  int sgetc() const { return at_ == last_ ? EOF : static_cast<unsigned char>(*at_); }
  int sbumpc() { return at_ == last_ ? EOF : static_cast<unsigned char>(*at_++); }

 private:
  const char* at_;
  const char* last_;
};

class stringbuf : public streambuf {
 public:
  explicit stringbuf(const string& text) : streambuf(text.data(), text.data() + text.size()) {}
};

struct ios {
  enum State { eofbit };
};

class istream {
 public:
  explicit istream(streambuf* buffer) : buffer_(buffer) {}
  int peek() const { return buffer_->sgetc(); }
  streambuf* rdbuf() { return buffer_; }
  void setstate(ios::State) { good_ = false; }
  explicit operator bool() const { return good_; }
  bool operator!() const { return !good_; }

  struct sentry {
    sentry(const istream&, bool) {}
    explicit operator bool() const { return true; }
  };

 private:
  streambuf* buffer_;
  bool good_ = true;
};

class istringstream : private stringbuf, public istream {
 public:
  explicit istringstream(const string& text) : stringbuf(text), istream(this) {}
};

inline istream& getline(istream& stream, string& line, char separator) {
  line.clear();
  if (stream.peek() == EOF) {
    stream.setstate(ios::eofbit);
  }
  for (int c = stream.rdbuf()->sbumpc(); c != EOF && c != separator; c = stream.rdbuf()->sbumpc()) {
    line += static_cast<char>(c);
  }
  return stream;
}

/// No file is ever found: Pliant reads the one it was given and no materials.
class ifstream : private streambuf, public istream {
 public:
  explicit ifstream(const char* /*path*/) : streambuf(nullptr, nullptr), istream(this) { setstate(ios::eofbit); }
};

/// Where tinyobjloader composes its messages.
class stringstream {
 public:
  stringstream& operator<<(const string& text) {
    text_ += text;
    return *this;
  }
  template <class Number>
  requires is_arithmetic_v<Number> stringstream& operator<<(Number number) {
    text_ += to_string(number);
    return *this;
  }
  const string& str() const { return text_; }

 private:
  string text_;
};

}  // namespace pliant::io::tinyobj_std
