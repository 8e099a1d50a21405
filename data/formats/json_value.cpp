#include "data/formats/json_value.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

namespace ostium::data {

namespace {

constexpr std::size_t deepest_nesting = 32;

/// How far the parser has read. After a number it reads one character ahead, so a token's line is the line of the last
/// character that is not white space.
struct Place {
  int line = 1, visible_line = 1;

  void pass(char c) {
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') visible_line = line;
    if (c == '\n') ++line;
  }
};

/// Iterator over the text that updates `Place`.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Place* place) : at_(at), place_(place) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    place_->pass(*at_++);
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  Place* place_;
};

/// Builds the tree from the parser's events.
class Builder {
 public:
  Builder(std::shared_ptr<const std::string> file, const Place& place) : file_(std::move(file)), place_(place) {}

  bool null() { return add(JsonValue::Type::null, 0, ""); }
  bool boolean(bool value) { return add(JsonValue::Type::boolean, value, ""); }
  bool number_integer(std::int64_t value) { return add(JsonValue::Type::number, static_cast<double>(value), ""); }
  bool number_unsigned(std::uint64_t value) { return add(JsonValue::Type::number, static_cast<double>(value), ""); }
  bool number_float(double value, const std::string&) { return add(JsonValue::Type::number, value, ""); }
  bool string(std::string& value) { return add(JsonValue::Type::text, 0, value); }
  bool binary(nlohmann::json::binary_t&) { return false; }  // does not occur in text
  bool start_object(std::size_t) { return open(JsonValue::Type::object); }
  bool start_array(std::size_t) { return open(JsonValue::Type::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& key) {
    key_ = key;
    JsonValue& object = *open_.back();
    if (object.find(key)) here().fail(fmt::format("\"{}\" is given twice; expected each key once", child_path(key)));
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    const std::string message = error.what();  // "[...] parse error at line 3, column 5: what it is"
    const std::size_t column = message.find("column");
    const std::size_t words = message.find(": ", column == std::string::npos ? 0 : column);
    here().fail("is not JSON: " + (words == std::string::npos ? message : message.substr(words + 2)));
  }

  JsonValue take() { return std::move(root_); }

 private:
  JsonValue here() const {
    JsonValue value;
    value.line = place_.visible_line;
    value.file = file_;
    return value;
  }

  std::string child_path(const std::string& key) const {
    return open_.back()->path.empty() ? key : open_.back()->path + "." + key;
  }

  JsonValue& place_value(JsonValue value) {
    if (open_.empty()) return root_ = std::move(value);
    JsonValue& parent = *open_.back();
    if (parent.type == JsonValue::Type::array) {
      value.path = fmt::format("{}[{}]", parent.path, parent.items.size());
      return parent.items.emplace_back(std::move(value));
    }
    value.path = child_path(key_);
    return parent.members.emplace_back(key_, std::move(value)).second;
  }

  bool add(JsonValue::Type type, double number, const std::string& text) {
    JsonValue value = here();
    value.type = type, value.number = number, value.text = text;
    place_value(std::move(value));
    return true;
  }

  bool open(JsonValue::Type type) {
    if (open_.size() == deepest_nesting) here().fail(fmt::format("nests deeper than {}", deepest_nesting));
    JsonValue value = here();
    value.type = type;
    // A parent's list grows only while none of its children is open, so pointers to open values stay valid.
    open_.push_back(&place_value(std::move(value)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::shared_ptr<const std::string> file_;
  const Place& place_;
  JsonValue root_;
  std::vector<JsonValue*> open_;
  std::string key_;
};

/// A value as shown in messages: short, on one line.
std::string found(const JsonValue& value) {
  switch (value.type) {
    case JsonValue::Type::null:
      return "null";
    case JsonValue::Type::boolean:
      return value.number != 0 ? "true" : "false";
    case JsonValue::Type::number:
      return fmt::format("{}", value.number);
    case JsonValue::Type::text:
      return "\"" + (value.text.size() > 40 ? value.text.substr(0, 40) + "..." : value.text) + "\"";
    case JsonValue::Type::object:
      return value.members.empty() ? "{}" : "{...}";
    case JsonValue::Type::array:
      break;
  }
  std::string list;
  for (std::size_t i = 0; i < value.items.size() && i < 4; ++i) list += (i ? ", " : "") + found(value.items[i]);
  return "[" + list + (value.items.size() > 4 ? ", ...]" : "]");
}

nlohmann::ordered_json plain(const JsonValue& value) {
  switch (value.type) {
    case JsonValue::Type::null:
      return nullptr;
    case JsonValue::Type::boolean:
      return value.number != 0;
    case JsonValue::Type::number:
      if (value.number == std::rint(value.number) && std::fabs(value.number) < 1e15)
        return static_cast<std::int64_t>(value.number);
      return value.number;
    case JsonValue::Type::text:
      return value.text;
    case JsonValue::Type::array: {
      nlohmann::ordered_json list = nlohmann::ordered_json::array();
      for (const JsonValue& item : value.items) list.push_back(plain(item));
      return list;
    }
    case JsonValue::Type::object:
      break;
  }
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const auto& [name, member] : value.members) object[name] = plain(member);
  return object;
}

}  // namespace

const JsonValue* JsonValue::find(const std::string& key) const {
  for (const auto& [name, value] : members)
    if (name == key) return &value;
  return nullptr;
}

void JsonValue::refuse(const std::string& expected) const {
  fail(fmt::format("{} is {}; expected {}", path.empty() ? "the file" : path, found(*this), expected));
}

void JsonValue::fail(const std::string& what) const { throw LoadError(fmt::format("{}:{}: {}", *file, line, what)); }

JsonValue parse_json(const std::string& file, const std::string& text) {
  Place place;
  Builder builder(std::make_shared<const std::string>(file), place);
  nlohmann::json::sax_parse(CountingIterator(text.data(), &place), CountingIterator(text.data() + text.size(), &place),
                            &builder);
  return builder.take();
}

JsonValue load_json(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  if (!stream || !text) throw LoadError(file + ": cannot be read; is it there, and a file with something in it?");
  return parse_json(file, text.str());
}

std::string to_json(const JsonValue& value) { return plain(value).dump(1) + "\n"; }

}  // namespace ostium::data
