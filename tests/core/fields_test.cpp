/// The lists of members beside the structs of state.
#include "core/base/fields.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/math/field.h"

namespace ostium::core {
namespace {

enum class Colour : unsigned char { red, green };

struct Bulb {
  bool on = false;
  int watts = -1;
  Colour colour = Colour::red;
  std::optional<Colour> shade;
};
constexpr auto fields(const Bulb*) {
  return std::tuple{field("on", &Bulb::on), field("watts", &Bulb::watts), field("colour", &Bulb::colour),
                    field("shade", &Bulb::shade)};
}

struct Room {
  std::uint64_t steps = 0;
  std::array<Bulb, 2> bulbs;
  std::vector<int> rooms = {1, 2, 3};
  std::array<double, 2> share{};
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();
  Field<2> along{5};
};
constexpr auto fields(const Room*) {
  return std::tuple{field("steps", &Room::steps), field("bulbs", &Room::bulbs), field("rooms", &Room::rooms),
                    field("share", &Room::share), field("p_W", &Room::p_W),     field("along", &Room::along)};
}

struct Forgotten {
  double listed = 0;
  std::array<double, 2> not_listed{};
};
constexpr auto fields(const Forgotten*) { return std::tuple{field("listed", &Forgotten::listed)}; }

struct NamedTwice {
  double one = 0, two = 0;
};
constexpr auto fields(const NamedTwice*) {
  return std::tuple{field("one", &NamedTwice::one), field("one", &NamedTwice::two)};
}

static_assert(lists_every_member<Bulb>() && lists_every_member<Room>());
static_assert(!lists_every_member<Forgotten>(), "for_each_field of it does not compile");
static_assert(!lists_every_member<NamedTwice>());

Room some_room() {
  Room room;
  room.steps = (std::uint64_t{1} << 63) + 1;  // not representable as a double
  room.bulbs[1] = {true, 60, Colour::green, Colour::red};
  room.rooms = {4, -5, 6};
  room.share = {0.1, std::nan("")};
  room.p_W = {1, -0.0, std::numeric_limits<double>::denorm_min()};
  room.along.set(3, {7, 8});
  return room;
}

TEST(Fields, ARowHoldsEveryNumberExactly) {
  const Room room = some_room();
  ASSERT_EQ(count_fields(room), 1u + 2 * 4 + 3 + 2 + 3 + 2 * 5);
  std::vector<double> row(count_fields(room));
  EXPECT_EQ(put_fields(room, row.data()), row.data() + row.size());
  Room back;
  EXPECT_EQ(take_fields(row.data(), back), row.data() + row.size());
  EXPECT_EQ(back.steps, room.steps);
  EXPECT_EQ(back.bulbs[0].shade, std::nullopt);
  EXPECT_EQ(back.bulbs[1].shade, Colour::red);
  EXPECT_EQ(back.rooms, room.rooms);
  EXPECT_EQ(first_different_field(room, back), "");
  EXPECT_EQ(hash_fields(room, 0), hash_fields(back, 0));
}

TEST(Fields, EachDifferenceIsHashedAndNamed) {
  const Room room = some_room();
  const auto differs = [&](const char* words, auto&& change) {
    Room other = room;
    change(other);
    EXPECT_EQ(first_different_field(room, other), words);
    EXPECT_NE(hash_fields(room, 0), hash_fields(other, 0)) << words;
  };
  differs("steps: 9223372036854775809 != 2", [](Room& r) { r.steps = 2; });
  differs("bulbs[1].on: 1 != 0", [](Room& r) { r.bulbs[1].on = false; });
  differs("bulbs[0].shade: -1 != 0", [](Room& r) { r.bulbs[0].shade = Colour::red; });
  differs("rooms[1]: -5 != 5", [](Room& r) { r.rooms[1] = 5; });
  differs("share[0]: 0.1 != 0.2", [](Room& r) { r.share[0] = 0.2; });
  differs("p_W[1]: -0 != 0", [](Room& r) { r.p_W.y() = 0; });
  differs("along[3]: 8 != 9", [](Room& r) { r.along.at(1)[3] = 9; });
  Room longer = room;
  longer.rooms.push_back(1);
  EXPECT_EQ(first_different_field(room, longer), "rooms: sizes differ");
}

}  // namespace
}  // namespace ostium::core
