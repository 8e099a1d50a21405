#include "data/formats/json/json_value.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_set>

#include "data/formats/controls.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace {

constexpr const char* no_control = "holds a control character; expected text as people read it";

/// Text for a message: without control characters, and no letter of UTF-8 is cut in two.
std::string shown(std::string_view text, std::size_t most) {
  std::string out(text.substr(0, most));
  if (text.size() > most) {
    std::size_t begin = out.size();  // of the letter that the cut goes through
    while (begin > 0 && (static_cast<unsigned char>(text[begin]) & 0xc0) == 0x80) --begin;
    out.resize(begin);
    out += "...";
  }
  return without_controls(out);
}

constexpr const char* white = "\t\n\r";  // what files call things is printed by every command

/// The parser's words without its prefix ("[...] parse error at line 3, column 5: ") and without what it read last,
/// which may be long and no UTF-8.
std::string words_of(const std::string& message) {
  const std::size_t column = message.find("column"), prefix = message.find("] ");
  const std::size_t colon = column == std::string::npos ? column : message.find(": ", column);
  std::string words = message.substr(colon != std::string::npos    ? colon + 2
                                     : prefix != std::string::npos ? prefix + 2
                                                                   : 0);
  if (const std::size_t read = words.find("; last read: "); read != std::string::npos) {
    const std::size_t expected = words.rfind("; expected ");
    words.erase(read, expected == std::string::npos || expected < read ? std::string::npos : expected - read);
  }
  return shown(words, 200);
}

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
    using namespace json_limits;
    if (key.size() > key_bytes)
      refuse(fmt::format("a key of {} bytes, \"{}\"", key.size(), shown(key, 40)), key_bytes, "bytes");
    if (has_control(key, white)) here().fail(fmt::format("the key \"{}\" {}", shown(key, 40), no_control));
    if (!keys_.back().insert(key).second)
      here().fail(fmt::format("\"{}\" is given twice; expected each key once", child(key).path()));
    if (keys_.back().size() > keys) refuse("an object of more keys", keys, "of them: is a file of another kind here");
    key_ = key;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& error) {
    here().fail("is not JSON: " + words_of(error.what()));
  }

  JsonValue take() { return std::move(root_); }

 private:
  JsonValue here() const {
    JsonValue value;
    value.line = place_.visible_line;
    value.file = file_;
    return value;
  }

  /// Refuses what the value that is open has.
  [[noreturn]] void refuse(const std::string& has, std::size_t most, const std::string& what) const {
    const std::string where = open_.empty() ? "" : open_.back()->path();
    here().fail(fmt::format("{} has {}; expected at most {} {}", where.empty() ? "the file" : where, has, most, what));
  }

  /// A value that begins here, in the object or array that is open.
  JsonValue child(const std::string& key) const {
    JsonValue value = here();
    if (open_.empty()) return value;
    const JsonValue& parent = *open_.back();
    const bool in_array = parent.type == JsonValue::Type::array;
    value.place = std::make_shared<const JsonPlace>(
        JsonPlace{parent.place, in_array ? "" : key, in_array ? std::optional(parent.items.size()) : std::nullopt});
    return value;
  }

  JsonValue& put(JsonValue value) {
    if (++values_ > json_limits::values) refuse("too many values before its end", json_limits::values, "in a file");
    if (open_.empty()) return root_ = std::move(value);
    JsonValue& parent = *open_.back();
    if (parent.type == JsonValue::Type::array) return parent.items.emplace_back(std::move(value));
    parent.members.push_back({key_, std::move(value)});
    return parent.members.back().value;
  }

  bool add(JsonValue::Type type, double number, const std::string& text) {
    if (text.size() > json_limits::text_bytes)
      refuse(fmt::format("a text of {} bytes, \"{}\"", text.size(), shown(text, 40)), json_limits::text_bytes, "bytes");
    JsonValue value = child(key_);
    if (has_control(text, white)) value.fail(fmt::format("{} \"{}\" {}", value.path(), shown(text, 40), no_control));
    value.type = type, value.number = number, value.text = text;
    put(std::move(value));
    return true;
  }

  bool open(JsonValue::Type type) {
    if (open_.size() == json_limits::depth)
      here().fail(fmt::format("nests deeper than {}; expected at most that", json_limits::depth));
    JsonValue value = child(key_);
    value.type = type;
    // A parent's list grows only while none of its children is open, so pointers to open values stay valid.
    open_.push_back(&put(std::move(value)));
    keys_.emplace_back();
    return true;
  }

  bool close() {
    open_.pop_back(), keys_.pop_back();
    return true;
  }

  std::shared_ptr<const std::string> file_;
  const Place& place_;
  JsonValue root_;
  std::vector<JsonValue*> open_;
  std::vector<std::unordered_set<std::string>> keys_;  ///< of what is open
  std::string key_;
  std::size_t values_ = 0;
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
      return "\"" + shown(value.text, 40) + "\"";
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

std::string JsonValue::path() const {
  std::string text;
  for (const JsonPlace* at = place.get(); at; at = at->parent.get())
    text = (at->index    ? fmt::format("[{}]", *at->index)
            : at->parent ? "." + shown(at->key, json_limits::key_bytes)
                         : shown(at->key, json_limits::key_bytes)) +
           text;
  return text;
}

void JsonValue::refuse(const std::string& expected) const {
  fail(fmt::format("{} is {}; expected {}", place ? path() : "the file", found(*this), expected));
}

void JsonValue::fail(const std::string& what) const { throw LoadError(fmt::format("{}:{}: {}", *file, line, what)); }

JsonValue parse_json(const std::string& file, const std::string& text) {
  if (text.size() > json_limits::bytes)
    throw LoadError(
        fmt::format("{}: has more than {} MiB; expected a file of JSON, at most so long: split it, or thin "
                    "out its lists",
                    file, json_limits::bytes >> 20));
  require_utf8(file, text);
  Place place;
  Builder builder(std::make_shared<const std::string>(file), place);
  nlohmann::json::sax_parse(CountingIterator(text.data(), &place), CountingIterator(text.data() + text.size(), &place),
                            &builder);
  return builder.take();
}

JsonValue load_json(const std::string& file) {
  const std::string text = read_file(file, "a file of JSON", json_limits::bytes);
  if (text.empty()) throw LoadError(file + ": holds nothing; expected a file of JSON");
  return parse_json(file, text);
}

std::string to_json(const JsonValue& value) { return plain(value).dump(1) + "\n"; }

}  // namespace ostium::data
