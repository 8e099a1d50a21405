#include "vascular/thorax/thorax.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/base/fields.h"
#include "core/base/units.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/implicit/draws.h"
#include "vascular/motion/heart_motion.h"
#include "vascular/thorax/chest_wall.h"
#include "vascular/thorax/lung_vessels.h"
#include "vascular/thorax/shapes.h"
#include "vascular/thorax/soft_parts.h"
#include "vascular/thorax/vertebra.h"

namespace ostium::vascular {

namespace {

using units::mm, units::degree;
Eigen::Vector3d at_mm(double x, double y, double z) { return Eigen::Vector3d(x, y, z) * mm; }

/// Centres of the vertebral bodies from T1 to L3, and half their heights.
struct Vertebra {
  double y_mm, half_height_mm;
};
constexpr Vertebra vertebrae[] = {{118, 8.5},   {96, 9},     {73, 9.2},   {50, 9.5},    {28, 9.8},
                                  {4, 10},      {-20, 10.2}, {-44, 10.4}, {-68, 10.6},  {-93, 11},
                                  {-119, 11.5}, {-146, 12},  {-176, 13},  {-208, 13.5}, {-242, 14}};

/// The bodies touch the descending aorta, which lies to the left of their front from T5 to T9, as CT shows it: 27 mm
/// between the axes, for radii of 12 and 15.
double spine_z_mm(double y_mm) { return -73 + 12 * std::pow((y_mm + 10) / 190, 2); }

/// Tubes whose distance is wanted at many points, most of them far away.
class Displacing {
 public:
  explicit Displacing(const std::vector<Tube>& tubes) : shape_(tubes), all_(shape_.segments().size()) {
    std::iota(all_.begin(), all_.end(), 0);
    for (const Tube& tube : tubes)
      for (const TubeNode& node : tube.nodes)
        for (double side : {-1.0, 1.0}) box_.extend(node.p + Eigen::Vector3d::Constant(side * node.radius_m));
    // Each tube more is blended with those before, which takes a sixth of the blend's width from the distance at most.
    lowered_m_ = static_cast<double>(tubes.size()) * shape_.largest_blend_m() / 6 + 0.01 * mm;
  }
  double distance(const Eigen::Vector3d& p) const { return shape_.value(p, all_); }

  /// The same as joined(mm, distance(p) in mm less `margin_mm`, k), bit for bit, without that distance where it is too
  /// long to matter.
  double joined_to(double other_mm, const Eigen::Vector3d& p, double margin_mm, double k) const {
    const double outside = box_.exteriorDistance(p);
    if (outside > 0 && (outside - lowered_m_) / mm - margin_mm > other_mm + k) return other_mm;
    return joined(other_mm, distance(p) / mm - margin_mm, k);
  }

 private:
  TubeUnion shape_;
  std::vector<int> all_;
  Eigen::AlignedBox3d box_;
  double lowered_m_ = 0;
};

/// The heart as spheres along its chambers; negative inside. Walls `wall_m` thick surround the blood.
class Heart {
 public:
  explicit Heart(const Anatomy& anatomy) {
    const Landmarks& m = anatomy.landmarks;
    const Eigen::Vector3d axis = m.p_lv_apex - m.p_lv_base;
    const Eigen::Vector3d groove = m.right_groove, front = axis.normalized().cross(groove);
    const auto along = [&](double s, double right_mm, double front_mm) {
      return Eigen::Vector3d(m.p_lv_base + s * axis + right_mm * mm * groove + front_mm * mm * front);
    };
    const auto add = [&](const char* name, const std::vector<CoursePoint>& course) {
      tubes_.push_back(make_tube(name, static_cast<int>(tubes_.size()) - 1, course));
      tubes_.back().blend = 0.5;
    };
    // Radii of the outer wall by fraction of the axis: Cardiac Atlas Project, mean of 2,291 people.
    add("left ventricle", {{along(0.12, 0, 0), 33 * mm},
                           {along(0.35, 0, 0), 34.4 * mm},
                           {along(0.55, 0, 0), 31 * mm},
                           {along(0.85, -2, 0), 16 * mm}});
    add("right ventricle",
        {{along(0.05, 34, 2), 22 * mm}, {along(0.35, 30, -8), 22 * mm}, {along(0.75, 18, -10), 13 * mm}});
    add("left atrium", {{along(-0.28, -2, 14), 24 * mm}, {along(-0.30, 8, 22), 22 * mm}});
    add("right atrium", {{along(-0.22, 44, 8), 21 * mm}, {along(-0.30, 38, 18), 22 * mm}});
    shape_ = std::make_unique<Displacing>(tubes_);
  }
  const Displacing& shape() const { return *shape_; }
  double distance(const Eigen::Vector3d& p) const { return shape_->distance(p); }
  Eigen::AlignedBox3d box() const {
    Eigen::AlignedBox3d b;
    for (const Tube& tube : tubes_)
      for (const TubeNode& node : tube.nodes)
        for (double r : {-1.4, 1.4}) b.extend(node.p + Eigen::Vector3d::Constant(r * node.radius_m));
    return b;
  }

 private:
  std::vector<Tube> tubes_;
  std::unique_ptr<Displacing> shape_;
};

void add_bone(std::vector<XrayBody>& bodies, const std::string& name, Mesh outer, Mesh inner,
              BodyTissue marrow = BodyTissue::spongy_bone) {
  bodies.push_back({name, BodyTissue::cortical_bone, BodyTissue::soft_tissue, std::move(outer), {}, {}});
  bodies.push_back({name + ", inside", marrow, BodyTissue::cortical_bone, std::move(inner), {}, {}});
}

/// Of thoracic bodies and end plates 0.25 to 0.5 mm (Silva 1994, Bone 15:617) [from memory].
constexpr double vertebral_cortex_mm = 0.35;

/// No spine is quite straight: each body leans a little from the line of all. [estimate: a curve of 10 degrees over
/// several bodies still counts as straight]
constexpr double vertebra_leans_deg = 2;

void add_spine(std::vector<XrayBody>& bodies, Draws& draw) {
  const auto shape = [](double inset_mm) {
    return surface_net([=](const Eigen::Vector3d& p) { return mm * (from_vertebra_mm(p / mm) + inset_mm); },
                       at_mm(-36, -28.5, -61), at_mm(36, 16.5, 18), 1.5 * mm);
  };
  const Mesh outer_shape = shape(0), inner_shape = shape(vertebral_cortex_mm);
  constexpr double half_height_mm = 10.9, half_width_mm = 16.2;  // of that shape's body
  Mesh outer, inner;
  for (const Vertebra& v : vertebrae) {
    const Eigen::Vector3d p = middle_x * Eigen::Vector3d::UnitX() + at_mm(0, v.y_mm, spine_z_mm(v.y_mm));
    const double wide = (12.5 + 0.36 * v.half_height_mm) / half_width_mm, slope = 24 * (v.y_mm + 10) / (190 * 190);
    const double forwards = vertebra_leans_deg * degree * draw.normal(),
                 sideways = vertebra_leans_deg * degree * draw.normal();
    const Eigen::Affine3d place = Eigen::Translation3d(p) * Eigen::AngleAxisd(sideways, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(forwards - slope, Eigen::Vector3d::UnitX()) *
                                  Eigen::Scaling(wide, v.half_height_mm / half_height_mm, wide);
    for (auto [mesh, local] : {std::pair(&outer, &outer_shape), std::pair(&inner, &inner_shape)}) {
      Mesh placed = *local;
      for (Eigen::Vector3d& q : placed.vertices) q = place * q;
      append(*mesh, placed);
    }
  }
  add_bone(bodies, "spine", outer, inner);
}

/// Those that hold the spine upright, beside the spinous processes: 54 mm wide and 34 thick [usual, from memory].
void add_muscles_of_the_back(std::vector<XrayBody>& bodies) {
  Mesh both;
  for (double side : {-1.0, 1.0}) {
    std::vector<Eigen::Vector3d> line;
    for (double y_mm = 130; y_mm > -280; y_mm -= 20)
      line.push_back(middle_x * Eigen::Vector3d::UnitX() + at_mm(side * 36, y_mm, spine_z_mm(y_mm) - 53));
    append(both, swept_ellipse(line, 27 * mm, 17 * mm, Eigen::Vector3d::UnitX()));
  }
  bodies.push_back({.name = "muscles of the back",
                    .tissue = BodyTissue::muscle,
                    .within = BodyTissue::soft_tissue,
                    .mesh = std::move(both)});
}

/// Ribs from their heads at the spine to the costal cartilage, where cortex and height taper out.
void add_ribs(std::vector<XrayBody>& bodies) {
  Mesh outer, inner;
  for (int rib = 1; rib <= 11; ++rib) {
    const double y0 = vertebrae[rib - 1].y_mm + 6, last_deg = rib == 1 ? 140 : rib < 8 ? 150 : 165 - 5.0 * rib;
    const double drop = std::min(30 + 9.0 * rib, 95.0) + 3 * std::sin(2.3 * rib);
    for (double side : {-1.0, 1.0}) {
      std::vector<Eigen::Vector3d> line;
      std::vector<Eigen::Vector2d> half, inside;
      for (int i = 0; i <= 48; ++i) {
        // Horizontal behind, steep at the side, flatter in front.
        const double t = i / 48.0, theta = (14 + (last_deg - 14) * t) * degree,
                     y = y0 + 3 * std::sin(units::pi * std::min(1.0, 3 * t)) -
                         drop * (0.7 * t * t * (3 - 2 * t) + 0.3 * t) + 1.5 * std::sin(6 * t + 1.7 * rib + side);
        const Eigen::Vector2d on = cage_mm(theta, y, 2);
        line.push_back(middle_x * Eigen::Vector3d::UnitX() + at_mm(side * on[0], y, on[1]));
        const double front = std::clamp((t - 0.72) / 0.28, 0.0, 1.0), neck = std::clamp(t / 0.12, 0.0, 1.0);
        const double tall = ((rib == 1 ? 4.8 : 5.4) + 0.3 * std::sin(3.1 * rib)) * (0.65 + 0.35 * neck) *
                            (1 + 0.05 * std::sin(11 * t + rib)) * (1 - 0.8 * front * front * front),
                     shell = 0.45 - 0.2 * std::sqrt(front);
        half.push_back(Eigen::Vector2d(tall, 0.58 * tall) * mm);
        inside.push_back(half.back().array() - shell * mm);
      }
      append(outer, swept_ellipse(line, half, Eigen::Vector3d::UnitY()));
      append(inner, swept_ellipse(line, inside, Eigen::Vector3d::UnitY()));
    }
  }
  add_bone(bodies, "ribs", outer, inner, BodyTissue::loose_bone);
}

/// Distance in mm to the sternum along y, through z: manubrium, the angle of Louis, a body notched for the ribs.
double from_sternum_mm(const Eigen::Vector3d& p) {
  const double y = p.y();
  const double notches = 1.4 * std::sin(0.27 * y + 0.6) + 0.6 * std::sin(0.61 * y);
  const double wide = 15 + 9 / (1 + std::exp(-(y - 30) / 4)) - 3 * std::exp(-std::pow((y - 26) / 7, 2)) -
                      5 * std::clamp(-(y + 40) / 40, 0.0, 1.0) + notches;
  // Lens-shaped across, so that its margin fades.
  const double across = 0.85 * (std::fabs(p.z()) - 5 * (1 - std::pow(p.x() / wide, 2)));
  const double ends = std::max(y - 82, -72 - y + 2.5 * std::cos(0.2 * p.x()));
  return -joined(-across, -ends, 12);
}

void add_front(std::vector<XrayBody>& bodies) {
  Mesh outer, inner;
  const Eigen::Vector3d x = middle_x * Eigen::Vector3d::UnitX();
  // Inclined forward, the manubrium more.
  const auto sternum = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d q = (p - x) / mm;
    return mm * from_sternum_mm({q.x(), q.y(), q.z() - 90 + 0.17 * q.y() + 0.0018 * q.y() * q.y()});
  };
  bodies.push_back({"sternum",
                    BodyTissue::loose_bone,
                    BodyTissue::soft_tissue,
                    surface_net(sternum, x + at_mm(-32, -80, 50), x + at_mm(32, 90, 110), 2 * mm),
                    {},
                    {}});
  for (double side : {-1.0, 1.0}) {
    std::vector<Eigen::Vector3d> line;
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0;
      line.push_back(x + at_mm(side * (24 + 130 * t), 88 + 22 * t, 58 - 70 * t + 14 * std::sin(2 * units::pi * t)));
    }
    append(outer, swept_ellipse(line, 6.5 * mm, 5.5 * mm, Eigen::Vector3d::UnitY()));
    append(inner, swept_ellipse({line.begin() + 1, line.end() - 1}, 5.2 * mm, 4.2 * mm, Eigen::Vector3d::UnitY()));
    // Shoulder blade: a thin plate, moved up and outwards because the arms are raised above the head.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(-60 * degree * side, Eigen::Vector3d::UnitY()).toRotationMatrix();
    const Eigen::Vector3d middle = x + at_mm(side * 132, 132, -72), half = at_mm(38, 72, 3.2);
    append(outer, superellipsoid(middle, half, 2.5, turn));
    append(inner, superellipsoid(middle, half.array() - 1.1 * mm, 2.5, turn));
  }
  add_bone(bodies, "shoulders", outer, inner);
}

/// Height of the diaphragm: two domes, the right one higher, with the heart's bed in between.
double diaphragm_mm(double x_mm, double z_mm) {
  const double right = std::exp(-std::pow((x_mm + 82) / 68, 2)), left = std::exp(-std::pow((x_mm - 78) / 62, 2));
  return -112 + 36 * right + 26 * left - 50 * std::pow((z_mm - 5) / 100, 2);
}

/// What moves about the heart: near it with the beat, everything by the breath.
void move_with_heart_and_breath(const Heart& heart, const HeartMotion& motion, XrayBody& body) {
  for (const Eigen::Vector3d& p : body.mesh.vertices) {
    const double near = 1 - smooth_step(2 * mm, 30 * mm, std::fabs(heart.distance(p)));
    body.beat.push_back(near > 0 ? Eigen::Vector3d(near * motion.displacement(p)) : Eigen::Vector3d::Zero());
    // The diaphragm descends 18 mm; the heart follows by a factor of 0.27 (Keegan 2002).
    body.breath.push_back(at_mm(0, -18 * (1 - smooth_step(-100 * mm, 40 * mm, p.y())), 0));
  }
}

class Lungs {
 public:
  Lungs(const Heart& heart, const std::vector<Displacing>& vessels) : heart_(heart), vessels_(vessels) {}

  /// Distance, negative inside, m.
  double operator()(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = p / mm;
    const double x = q.x() - middle_x / mm, cage = from_cage_mm(q, -5);
    const double base = diaphragm_mm(q.x(), q.z()) - q.y();
    // The mediastinum: oesophagus, spine, great vessels, heart; wider at the top. In front the lungs almost meet.
    double solid = std::fabs(x) - 17 + 12 * smooth_step(5, 60, q.z()) - 12 * smooth_step(30, 100, q.y());
    // The spine with the muscles beside and behind it, fuller beside each body: boxy, with round corners, which fade
    // where an oblique view looks along them. Its borders wander, each in its own way.
    const double side = x < 0 ? 1.3 : 0, y = q.y();
    const double wide = 38 * (1 + 0.025 * std::cos(2 * units::pi * (y - 4) / 25) + 0.05 * std::sin(y / 31 + 2 * side) +
                              0.03 * std::sin(y / 13 + side));
    const double column =
        (std::pow(std::pow(std::fabs(x) / wide, 3.5) + std::pow(std::fabs(q.z() - spine_z_mm(y) + 18) / 42, 3.5),
                  1 / 3.5) -
         1) *
        38;
    solid = joined(solid, column, 14);
    solid = heart_.shape().joined_to(solid, p, 1, 20);
    for (const Displacing& vessel : vessels_) solid = vessel.joined_to(solid, p, 3, 12);
    return mm * std::max({cage, base, -solid, q.y() - 122});
  }

 private:
  const Heart& heart_;
  const std::vector<Displacing>& vessels_;
};

void add_lungs(std::vector<XrayBody>& bodies, const Heart& heart, const Lungs& lungs, const HeartMotion& motion,
               Draws& draw) {
  XrayBody body{.name = "lungs",
                .tissue = BodyTissue::lung,
                .within = BodyTissue::soft_tissue,
                .mesh = surface_net(lungs, at_mm(-165, -200, -125), at_mm(155, 130, 110), 5 * mm),
                .density = draw.between(0.8, 1.25)};
  move_with_heart_and_breath(heart, motion, body);
  bodies.push_back(std::move(body));
  LungVesselOptions options;
  options.seed = static_cast<std::uint64_t>(draw.between(1, 1e6));
  // Those beside the heart move with it; the others are drawn once for a pose of the C-arm.
  std::vector<LungVessel> still, moving;
  for (const LungVessel& v : grow_lung_vessels(lungs, options))
    (std::min(heart.distance(v.a), heart.distance(v.b)) < 22 * mm ? moving : still).push_back(v);
  XrayBody quiet{
      .name = "lung vessels", .tissue = BodyTissue::blood, .within = BodyTissue::lung, .mesh = mesh_of(still)};
  XrayBody beside{.name = "lung vessels beside the heart",
                  .tissue = BodyTissue::blood,
                  .within = BodyTissue::lung,
                  .mesh = mesh_of(moving)};
  move_with_heart_and_breath(heart, motion, quiet);
  move_with_heart_and_breath(heart, motion, beside);
  quiet.beat.clear();
  bodies.push_back(std::move(quiet));
  bodies.push_back(std::move(beside));
}

/// The pulmonary trunk with its branches, and the venae cavae; the aorta is the anatomy's.
std::vector<std::vector<Tube>> great_vessels() {
  return {
      {make_tube("pulmonary trunk", -1,
                 {{at_mm(8, -14, 44), 13 * mm},
                  {at_mm(14, 12, 26), 13 * mm},
                  {at_mm(10, 26, 2), 12 * mm},
                  {at_mm(-6, 22, -18), 10 * mm},
                  {at_mm(-48, 10, -28), 8 * mm}}),
       make_tube("left pulmonary artery", 0,
                 {{at_mm(12, 26, 4), 11 * mm}, {at_mm(24, 30, -22), 9.5 * mm}, {at_mm(48, 14, -42), 7.5 * mm}})},
      {make_tube("superior vena cava", -1,
                 {{at_mm(-48, 78, -2), 9 * mm}, {at_mm(-49, 40, -2), 10 * mm}, {at_mm(-50, 6, 0), 10.5 * mm}})},
      {make_tube("inferior vena cava", -1,
                 {{at_mm(-38, -62, -4), 12 * mm}, {at_mm(-34, -85, -16), 12 * mm}, {at_mm(-30, -130, -34), 11 * mm}})}};
}

/// Walls and blood of the heart differ by a hundredth and are one body.
void add_heart(std::vector<XrayBody>& bodies, const Heart& heart, const std::vector<TubeUnion>& vessels,
               const HeartMotion& motion, Draws& draw) {
  const Eigen::AlignedBox3d box = heart.box();
  const auto wall = [&](const Eigen::Vector3d& p) { return heart.distance(p); };
  XrayBody body{.name = "heart",
                .tissue = BodyTissue::muscle,
                .within = BodyTissue::soft_tissue,
                .mesh = surface_net(wall, box.min(), box.max(), 5 * mm)};
  XrayBody fat = heart_fat(wall, box, 110, draw);
  for (XrayBody* b : {&body, &fat}) {
    for (const Eigen::Vector3d& p : b->mesh.vertices) {
      b->beat.push_back(motion.displacement(p));
      b->breath.push_back(motion.breath_displacement(p, 1));
    }
    bodies.push_back(std::move(*b));
  }
  Mesh great;
  for (const TubeUnion& vessel : vessels) append(great, contour(vessel).mesh);
  bodies.push_back({"great vessels", BodyTissue::blood, BodyTissue::soft_tissue, std::move(great), {}, {}});
}

void add_trunk(std::vector<XrayBody>& bodies, Draws& draw) {
  bodies.push_back({"trunk", BodyTissue::soft_tissue, BodyTissue::air, skin(), {}, {}});
  ChestWall wall;
  wall.middle_x_mm = middle_x / mm;
  wall.inner_mm = [](double y) { return Eigen::Vector2d(cage_half_axes_mm(y).array() + 9); };
  wall.outer_mm = [](double) { return within_skin_mm(); };
  bodies.push_back(wall_fat(wall, 480, draw));
}

/// Every fourth node: enough for a shadow.
Tube coarse(const Tube& tube) {
  Tube few{.name = tube.name, .nodes = {}};
  for (std::size_t i = 0; i < tube.nodes.size(); i += 4)
    if (tube.nodes[i].p.y() > -170 * mm) few.nodes.push_back(tube.nodes[i]);
  return few;
}

}  // namespace

std::vector<XrayBody> make_thorax(const Anatomy& anatomy) {
  const Heart heart(anatomy);
  const HeartMotion motion(anatomy.landmarks);
  const auto seed = core::hash_numbers(std::span<const double>(anatomy.landmarks.p_lv_apex.data(), 3), 0);
  Draws draw(seed);
  std::vector<XrayBody> bodies;
  add_trunk(bodies, draw);
  std::vector<std::vector<Tube>> tubes = great_vessels();
  tubes.push_back({coarse(anatomy.tubes.front())});
  const std::vector<TubeUnion> vessels(tubes.begin(), tubes.end());
  std::vector<Displacing> displacing(tubes.begin(), tubes.end());
  add_lungs(bodies, heart, Lungs(heart, displacing), motion, draw);
  add_heart(bodies, heart, vessels, motion, draw);
  bodies.push_back(stomach_gas(diaphragm_mm, draw));
  add_spine(bodies, draw);
  add_muscles_of_the_back(bodies);
  add_ribs(bodies);
  add_front(bodies);
  return bodies;
}

Mesh at(const XrayBody& body, double contraction, double breath_depth) {
  Mesh mesh = body.mesh;
  for (std::size_t i = 0; i < body.beat.size(); ++i) mesh.vertices[i] += contraction * body.beat[i];
  for (std::size_t i = 0; i < body.breath.size(); ++i) mesh.vertices[i] += breath_depth * body.breath[i];
  return mesh;
}

}  // namespace ostium::vascular
