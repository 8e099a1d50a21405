#pragma once
/// JSON of made-up sets, written by hand, so that generators need nothing of what they test.
#include <cstdio>
#include <string>
#include <vector>

namespace ostium::bench_sets {

inline std::string made_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return text;
}
inline std::string made_list(const std::vector<double>& x) {
  std::string out = "[";
  for (std::size_t i = 0; i < x.size(); ++i) out += (i > 0 ? ", " : "") + made_number(x[i]);
  return out + "]";
}

/// An object, key by key.
class MadeJson {
 public:
  MadeJson& raw(const std::string& key, const std::string& json) {
    text_ += (text_.empty() ? "\"" : ",\n\"") + key + "\": " + json;
    return *this;
  }
  MadeJson& text(const std::string& key, const std::string& value) { return raw(key, "\"" + value + "\""); }
  MadeJson& number(const std::string& key, double value) { return raw(key, made_number(value)); }
  MadeJson& list(const std::string& key, const std::vector<double>& value) { return raw(key, made_list(value)); }
  MadeJson& object(const std::string& key, const MadeJson& value) { return raw(key, value.done()); }
  MadeJson& items(const std::string& key, const std::vector<std::string>& value) {
    std::string list = "[";
    for (std::size_t i = 0; i < value.size(); ++i) list += (i > 0 ? ",\n" : "") + value[i];
    return raw(key, list + "]");
  }
  std::string done() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

}  // namespace ostium::bench_sets
