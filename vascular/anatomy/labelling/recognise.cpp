#include "vascular/anatomy/labelling/recognise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vascular/anatomy/labelling/courses.h"
#include "vascular/anatomy/labelling/fit.h"
#include "vascular/anatomy/labelling/mean_courses.h"
#include "vascular/box_tree.h"
#include "vascular/geometry/repair/mend.h"
#include "vascular/tree/centreline.h"

namespace ostium {

namespace {

constexpr double mm = 1e-3, degree = std::numbers::pi / 180;
constexpr double aorta_radius_m = 7e-3;       // an aorta is wider
constexpr double coronary_radius_m = 3.5e-3;  // a coronary artery is narrower
constexpr double coronary_length_m = 25e-3;   // and longer
constexpr double root_m = 75e-3;              // it leaves the aorta so near to its root
constexpr double vessel_shape = 6;            // a vessel is longer than so many of its widths
constexpr double most_turned = 40 * degree;   // the file's axes are kept if the anatomy is turned by less
constexpr double step_m = 5e-3;
constexpr double branch_blend = 1.6;  // in radii: over so much a branch takes over from its parent in the beat

struct Part {
  Mesh mesh;
  SphereTree tree;
  std::vector<Course> courses;
  Eigen::Vector3d root;
  double widest_m = 0;
  struct Role {
    Eigen::Vector3d end;
    std::string name;
  };
  std::vector<Role> roles;  ///< ends that are recognised, in the order of their importance
};

/// The coronary arteries that come out of one ostium.
struct Trunk {
  std::size_t part;
  Eigen::Vector3d root;  ///< where the part's tree begins then
  std::vector<Eigen::Vector3d> ends;
  std::vector<Course> courses;  ///< to these, from the ostium on
};

struct HeartFit {
  Similarity fit;
  double score = 1e9;
  int left = -1, right = -1;  ///< trunks
  std::size_t lad = 0, lcx = 0, rca = 0;
  bool circumflex = false;
};

class Recogniser {
 public:
  Recogniser(const Mesh& lumen, const RecogniseOptions& options)
      : lumen_(lumen), options_(options), mean_(mean_courses()) {}

  Recognised run() {
    look();
    find_aorta();
    find_heart();
    settle_axes();
    build_tubes();
    name_all();
    set_landmarks();
    move_to_ostium();
    return std::move(result_);
  }

 private:
  void say(const std::string& what) const {
    if (options_.progress) options_.progress(what);
  }

  void look() {
    double longest = 0, widest = 0;
    for (Mesh& mesh : components_of(lumen_)) {
      say(fmt::format("looking for centrelines in lumen {}", parts_.size() + 1));
      Part part{.mesh = std::move(mesh), .tree = {}, .courses = {}, .root = {}, .roles = {}};
      part.tree = find_centrelines(part.mesh).tree;
      if (part.tree.branches.empty() || part.tree.branches[0].spheres.size() < 2) continue;
      part.courses = courses_of(part.tree);
      part.root = part.tree.branches[0].spheres.front().p;
      for (const TreeBranch& branch : part.tree.branches)
        for (const TreeSphere& sphere : branch.spheres) part.widest_m = std::max(part.widest_m, sphere.radius_m);
      for (const Course& course : part.courses) longest = std::max(longest, course.length_m());
      widest = std::max(widest, part.widest_m);
      parts_.push_back(std::move(part));
    }
    if (parts_.empty() || longest < vessel_shape * 2 * widest)
      throw MeshError(fmt::format(
          "this is no vessel: the longest way through it is {:.0f} mm, its widest place {:.0f} mm; expected a way at "
          "least {:.0f} times as long as wide",
          longest / mm, 2 * widest / mm, vessel_shape));
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const Part& a, const Part& b) { return a.widest_m > b.widest_m; });
  }

  /// How unlike the mean aorta a course is, in metres; `fit` gets how that is laid on it.
  double unlike_aorta(const Course& course, Similarity& fit) const {
    const std::vector<Eigen::Vector3d> theirs = course.points(0, step_m, 0.3);
    double best = 1e9;
    // The root may have been cut off somewhere.
    for (double from = 0; from < 60 * mm; from += step_m) {
      std::vector<Eigen::Vector3d> ours = mean_.aorta.points(from, step_m, 0.3), same = theirs;
      const std::size_t n = std::min(ours.size(), same.size());
      if (n < 4) continue;
      ours.resize(n);
      same.resize(n);
      const Similarity found = nearest_similarity(ours, same);
      if (found.scale < 0.6 || found.scale > 1.7 || found.rms_m > best) continue;
      best = found.rms_m;
      fit = found;
    }
    return best;
  }

  /// Of all ways between two ends, the one that is most like the mean aorta; it begins at the root.
  void find_aorta() {
    Part& part = parts_.front();
    if (part.widest_m < aorta_radius_m) return;
    has_aorta_ = true;
    struct Way {
      double unlike, length;
      int root;
    };
    std::vector<Way> found;
    const std::vector<Course> candidates = with_wide_ends(part.courses);
    for (int from = -1; from < static_cast<int>(candidates.size()); ++from) {
      const std::vector<Course> ways = courses_from(candidates, from);
      if (ways.empty() || widest_at_end(candidates, from) < aorta_radius_m) continue;
      double longest = 0;
      for (const Course& way : ways) longest = std::max(longest, way.length_m());
      Similarity fit;
      for (const Course& way : ways)
        if (way.length_m() >= 0.6 * longest) found.push_back({unlike_aorta(way, fit), way.length_m(), from});
    }
    double best = 1e9, farthest = 0;
    int root = -1;
    for (const Way& way : found) best = std::min(best, way.unlike);
    // Of several that are much the same, the one that begins deepest in the root.
    for (const Way& way : found)
      if (way.unlike < best + 4 * mm && way.length > farthest) farthest = way.length, root = way.root;
    if (root >= 0) {
      say("looking for centrelines from the aortic root");
      part.root = to_the_end(candidates[static_cast<std::size_t>(root)], part.mesh);
      part.tree = find_centrelines(part.mesh, {.start = part.root, .ends = {}}).tree;
      part.courses = courses_of(part.tree);
    }
    double longest = 0;
    for (const Course& course : part.courses) longest = std::max(longest, course.length_m());
    std::size_t chosen = 0;
    std::vector<std::pair<double, Similarity>> compared;
    best = 1e9;
    for (const Course& course : part.courses) {
      Similarity fit;
      compared.emplace_back(unlike_aorta(course, fit) + (course.length_m() < 0.6 * longest ? 1 : 0), fit);
      best = std::min(best, compared.back().first);
    }
    // Ways into side branches are like it too, as far as they go.
    farthest = 0;
    for (std::size_t c = 0; c < compared.size(); ++c)
      if (const double length = part.courses[c].length_m(); compared[c].first < best + 4 * mm && length > farthest)
        farthest = length, chosen = c, aorta_fit_ = compared[c].second;
    part.roles.push_back({part.courses[chosen].spheres.back().p, "aorta"});
    aorta_ = part.courses[chosen];
    result_.aorta_rms_m = aorta_fit_.rms_m;
  }

  /// A root that coronary arteries leave is no end of the tree: it ends where a way becomes narrow.
  static std::vector<Course> with_wide_ends(std::vector<Course> courses) {
    const std::size_t n = courses.size();
    for (std::size_t c = 0; c < n; ++c) {
      std::size_t last = courses[c].spheres.size();
      while (last > 0 && courses[c].spheres[last - 1].radius_m < aorta_radius_m) --last;
      if (last < 2) continue;
      const Eigen::Vector3d end = courses[c].spheres[last - 1].p;
      bool there = false;
      for (const Course& other : courses) there = there || (other.spheres.back().p - end).norm() < 5 * mm;
      if (there) continue;
      Course wide;
      wide.spheres.assign(courses[c].spheres.begin(), courses[c].spheres.begin() + static_cast<long>(last));
      courses.push_back(std::move(wide));
    }
    return courses;
  }

  /// On from the last sphere to just before the wall.
  static Eigen::Vector3d to_the_end(const Course& course, const Mesh& mesh) {
    const TreeSphere& last = course.spheres.back();
    std::size_t before = course.spheres.size() - 1;
    while (before > 0 && last.s_m - course.spheres[before].s_m < 1.5 * last.radius_m) --before;
    const Eigen::Vector3d along = (last.p - course.spheres[before].p).normalized();
    const auto hits = BoxTree(mesh).hits(last.p, along, 40 * mm);
    return hits.empty() ? last.p : Eigen::Vector3d(last.p + std::max(0.0, hits[0].distance_m - 2 * mm) * along);
  }

  /// Within 30 mm of the end of a course, or of the root (-1).
  static double widest_at_end(const std::vector<Course>& courses, int from) {
    const Course& course = courses[static_cast<std::size_t>(std::max(from, 0))];
    double widest = 0;
    for (const TreeSphere& sphere : course.spheres)
      if ((from < 0 ? sphere.s_m : course.length_m() - sphere.s_m) < 30 * mm)
        widest = std::max(widest, sphere.radius_m);
    return widest;
  }

  bool like_coronary(const Course& course) const {
    if (course.spheres.size() < 4 || course.length_m() < coronary_length_m) return false;
    std::vector<double> first;
    for (const TreeSphere& sphere : course.spheres)
      if (sphere.s_m > 3 * mm && sphere.s_m < 20 * mm) first.push_back(sphere.radius_m);
    if (first.empty()) return false;
    std::nth_element(first.begin(), first.begin() + static_cast<long>(first.size() / 2), first.end());
    return first[first.size() / 2] < coronary_radius_m && median_radius(course) < coronary_radius_m;
  }

  std::vector<Trunk> find_trunks() const {
    std::vector<Trunk> trunks;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const std::vector<Course>& courses = parts_[p].courses;
      if (has_aorta_ && p == 0) {
        for (const Course& course : courses) {
          const Course rest = beyond(course, aorta_);
          if (!like_coronary(rest) || course.length_m() - rest.length_m() > root_m) continue;
          std::size_t t = 0;
          while (t < trunks.size() && (trunks[t].courses[0].spheres[0].p - rest.spheres[0].p).norm() >= 4 * mm) ++t;
          if (t == trunks.size()) trunks.push_back({p, parts_[p].root, {}, {}});
          trunks[t].ends.push_back(course.spheres.back().p);
          trunks[t].courses.push_back(rest);
        }
      } else if (parts_[p].widest_m < coronary_radius_m) {
        // Any of its wider ends may be its ostium.
        double widest = 0;
        for (const Course& course : courses)
          for (std::size_t i = 0; i < course.spheres.size(); i += course.spheres.size() - 1)
            widest = std::max(widest, course.spheres[i].radius_m);
        for (int from = -1; from < static_cast<int>(courses.size()); ++from) {
          Trunk trunk{p, {}, {}, {}};
          for (const Course& course : courses_from(courses, from))
            if (like_coronary(course)) {
              trunk.root = course.spheres.front().p;
              trunk.ends.push_back(course.spheres.back().p);
              trunk.courses.push_back(course);
            }
          if (!trunk.ends.empty() && trunk.courses[0].spheres.front().radius_m > 0.5 * widest)
            trunks.push_back(std::move(trunk));
        }
      }
    }
    return trunks;
  }

  static void add_pairs(const Course& ours, const Course& theirs, std::vector<Eigen::Vector3d>& from,
                        std::vector<Eigen::Vector3d>& to) {
    std::vector<Eigen::Vector3d> a = ours.points(0, step_m, 0.11), b = theirs.points(0, step_m, 0.11);
    const std::size_t n = std::min(a.size(), b.size());
    from.insert(from.end(), a.begin(), a.begin() + static_cast<long>(n));
    to.insert(to.end(), b.begin(), b.begin() + static_cast<long>(n));
  }

  void try_fit(HeartFit candidate, const std::vector<Trunk>& trunks, HeartFit& best) const {
    std::vector<Eigen::Vector3d> from, to;
    double unused = 0;
    const auto add = [&](const Course& ours, int trunk, std::size_t end) {
      const std::vector<Course>& all = trunks[static_cast<std::size_t>(trunk)].courses;
      double longest = 0;
      for (const Course& course : all) longest = std::max(longest, course.length_m());
      unused += longest - all[end].length_m();
      add_pairs(ours, all[end], from, to);
    };
    if (candidate.left >= 0) add(mean_.lad, candidate.left, candidate.lad);
    if (candidate.circumflex) add(mean_.lcx, candidate.left, candidate.lcx);
    if (candidate.right >= 0) add(mean_.rca, candidate.right, candidate.rca);
    if (from.size() < 8) return;
    candidate.fit = nearest_similarity(from, to);
    if (candidate.fit.scale < 0.6 || candidate.fit.scale > 1.6) return;
    candidate.score = candidate.fit.rms_m + 0.05 * unused;
    if (has_aorta_) {
      const double turn = Eigen::AngleAxisd(candidate.fit.R * aorta_fit_.R.transpose()).angle();
      candidate.score += 0.2 * mm * std::max(0.0, turn / degree - 20);
    }
    // Where the aorta says that the ostia are.
    const auto misplaced = [&](int trunk, const Eigen::Vector3d& ostium) {
      const double off = (trunks[trunk].courses[0].spheres.front().p - aorta_fit_ * ostium).norm();
      candidate.score += 0.3 * std::max(0.0, off - 20 * mm);
    };
    if (has_aorta_ && candidate.left >= 0) misplaced(candidate.left, mean_.anatomy.landmarks.p_left_ostium);
    if (has_aorta_ && candidate.right >= 0) misplaced(candidate.right, mean_.anatomy.landmarks.p_right_ostium);
    // More arteries recognised is better than fewer.
    candidate.score += (candidate.left < 0 || candidate.right < 0 ? 10 * mm : 0) + (candidate.circumflex ? 0 : 5 * mm);
    if (candidate.score < best.score) best = candidate;
  }

  void find_heart() {
    const std::vector<Trunk> trunks = find_trunks();
    HeartFit best;
    const int n = static_cast<int>(trunks.size());
    for (int left = -1; left < n; ++left)
      for (int right = -1; right < n; ++right) {
        if (left == right) continue;
        if (left >= 0 && right >= 0 && trunks[left].part == trunks[right].part &&
            !(has_aorta_ && trunks[left].part == 0))
          continue;
        const std::size_t rights = right < 0 ? 1 : trunks[right].ends.size();
        const std::size_t lefts = left < 0 ? 1 : trunks[left].ends.size();
        for (std::size_t rca = 0; rca < rights; ++rca)
          for (std::size_t lad = 0; lad < lefts; ++lad) {
            try_fit({.fit = {}, .left = left, .right = right, .lad = lad, .rca = rca}, trunks, best);
            for (std::size_t lcx = 0; left >= 0 && lcx < lefts; ++lcx) {
              if (lcx == lad || trunks[left].courses[lad].parts_from(trunks[left].courses[lcx]) > 45 * mm) continue;
              try_fit({.fit = {}, .left = left, .right = right, .lad = lad, .lcx = lcx, .rca = rca, .circumflex = true},
                      trunks, best);
            }
          }
      }
    if (best.score > 25 * mm) {
      if (n > 0) result_.notes.push_back("narrow vessels near the root are not like coronary arteries: nothing beats");
      return;
    }
    result_.heart = true;
    result_.heart_rms_m = best.fit.rms_m;
    heart_fit_ = best.fit;
    if (best.left >= 0 && !best.circumflex) find_circumflex(trunks[static_cast<std::size_t>(best.left)], best);
    if (best.left >= 0) {
      const Trunk& left = trunks[best.left];
      parts_[left.part].root = left.root;
      parts_[left.part].roles.push_back({left.ends[best.lad], "LAD"});
      if (best.circumflex) parts_[left.part].roles.push_back({left.ends[best.lcx], "LCx"});
      ostium_["LM"] = left.courses[best.lad].spheres.front().p;
    }
    if (best.right >= 0) {
      const Trunk& right = trunks[best.right];
      parts_[right.part].root = right.root;
      parts_[right.part].roles.push_back({right.ends[best.rca], "RCA"});
      ostium_["RCA"] = right.courses[best.rca].spheres.front().p;
    }
    if (best.left < 0) result_.notes.push_back("no left coronary artery was recognised");
    if (best.right < 0) result_.notes.push_back("no right coronary artery was recognised");
  }

  /// One that is not like the mean, but nearer to it than all others.
  void find_circumflex(const Trunk& left, HeartFit& best) const {
    double nearest = 25 * mm;
    for (std::size_t c = 0; c < left.courses.size(); ++c) {
      if (c == best.lad || left.courses[best.lad].parts_from(left.courses[c]) > 45 * mm) continue;
      std::vector<Eigen::Vector3d> ours, theirs;
      add_pairs(mean_.lcx, left.courses[c], ours, theirs);
      double sum = 0;
      for (std::size_t i = 0; i < ours.size(); ++i) sum += (best.fit * ours[i] - theirs[i]).squaredNorm();
      const double off = std::sqrt(sum / static_cast<double>(ours.size()));
      if (off < nearest) nearest = off, best.lcx = c, best.circumflex = true;
    }
  }

  /// From the mean anatomy's frame to the file's.
  const Similarity& fit() const { return result_.heart ? heart_fit_ : aorta_fit_; }

  void settle_axes() {
    Eigen::Matrix3d& R = result_.R_PF;
    if (options_.axes) {
      R = *options_.axes;
    } else if (!has_aorta_ && !result_.heart) {
      result_.notes.push_back("neither aorta nor heart was recognised: the file's axes are taken as left, head, front");
    } else {
      const Eigen::Matrix3d found = (has_aorta_ ? aorta_fit_.R : heart_fit_.R).transpose();
      double turn = 0;
      R = nearest_axes(found, &turn);
      if (turn > most_turned) {
        R = found;
        result_.notes.push_back(fmt::format(
            "the anatomy is turned by {:.0f} degrees from any axes: it was turned to stand as the mean one does",
            turn / degree));
      }
    }
    for (Part& part : parts_) {
      // Once more, with the ends in the order of their importance: what comes first runs through.
      CentrelineOptions wanted;
      wanted.start = part.root;
      for (const Part::Role& role : part.roles) wanted.ends.push_back(role.end);
      std::vector<const Course*> rest;
      for (const Course& course : part.courses) rest.push_back(&course);
      std::stable_sort(rest.begin(), rest.end(),
                       [](const Course* a, const Course* b) { return a->length_m() > b->length_m(); });
      std::vector<Eigen::Vector3d> others;
      for (const Course* course : rest) others.push_back(course->spheres.back().p);
      others.push_back(part.courses[0].spheres.front().p);
      for (const Eigen::Vector3d& end : others) {
        bool there = (end - part.root).norm() < 2 * mm;
        for (const Eigen::Vector3d& other : wanted.ends) there = there || (end - other).norm() < 1e-9;
        if (!there) wanted.ends.push_back(end);
      }
      say("naming branches");
      part.tree = find_centrelines(part.mesh, wanted).tree;
    }
    const auto turned = [&](Eigen::Vector3d& p) { p = R * p; };
    for (Part& part : parts_) {
      for (TreeBranch& branch : part.tree.branches)
        for (TreeSphere& sphere : branch.spheres) turned(sphere.p);
      for (Part::Role& role : part.roles) turned(role.end);
    }
    for (auto& [name, p] : ostium_) turned(p);
    result_.lumen = lumen_;
    for (Eigen::Vector3d& p : result_.lumen.vertices) turned(p);
    for (Similarity* s : {&aorta_fit_, &heart_fit_}) s->R = R * s->R, s->shift = R * s->shift;
  }

  /// From where it leaves its parent's wall, with a little of it inside; false if it never does.
  bool trimmed(const TreeBranch& branch, const Tube* parent, Tube& tube, double& leaves_m) const {
    const std::vector<TreeSphere>& s = branch.spheres;
    std::size_t begin = 0, exit = 0;
    if (parent) {
      const auto depth = [&](std::size_t i) {
        const TubeNode at = parent->at(nearest_s(*parent, s[i].p));
        return (s[i].p - at.p).norm() / at.radius_m;
      };
      while (exit < s.size() && depth(exit) < 1) ++exit;
      if (exit + 2 >= s.size() || s.back().s_m - s[exit].s_m < 3 * mm) return false;
      while (begin < exit && depth(begin) < 0.55) ++begin;
      if (begin == exit && begin > 0) --begin;
    } else {
      // A root runs up to the wall, where spheres shrink.
      std::vector<double> radii;
      for (std::size_t i = 0; i < std::min<std::size_t>(12, s.size()); ++i) radii.push_back(s[i].radius_m);
      std::nth_element(radii.begin(), radii.begin() + static_cast<long>(radii.size() / 2), radii.end());
      while (begin + 4 < s.size() && s[begin].radius_m < 0.75 * radii[radii.size() / 2]) ++begin;
      exit = begin;
    }
    std::vector<double> own;
    for (std::size_t i = exit; i < std::min(exit + 7, s.size()); ++i) own.push_back(s[i].radius_m);
    std::nth_element(own.begin(), own.begin() + static_cast<long>(own.size() / 2), own.end());
    std::vector<CoursePoint> course;
    for (std::size_t i = begin; i < s.size(); ++i) {
      if (!course.empty() && (s[i].p - course.back().p).norm() < 0.3 * s[i].radius_m && i + 1 < s.size()) continue;
      if (!course.empty() && (s[i].p - course.back().p).norm() < 1e-6) continue;
      course.push_back({s[i].p, i < exit ? std::min(s[i].radius_m, own[own.size() / 2]) : s[i].radius_m});
    }
    if (course.size() < 2) return false;
    tube = make_tube("", -1, course);
    leaves_m = nearest_s(tube, s[exit].p);
    return true;
  }

  void build_tubes() {
    Anatomy& anatomy = result_.anatomy;
    anatomy.aorta = has_aorta_;
    for (Part& part : parts_) {
      std::vector<int> tube_of;
      std::vector<Eigen::Vector3d> ends;
      const std::size_t first = anatomy.tubes.size();
      for (const TreeBranch& branch : part.tree.branches) {
        const int parent = branch.parent < 0 ? -1 : tube_of[static_cast<std::size_t>(branch.parent)];
        Tube tube;
        double leaves_m = 0;
        if (!trimmed(branch, parent < 0 ? nullptr : &anatomy.tubes[static_cast<std::size_t>(parent)], tube, leaves_m)) {
          tube_of.push_back(parent < 0 ? 0 : parent);
          continue;
        }
        tube.parent = parent;
        tube.blend = branch_blend;
        tube_of.push_back(static_cast<int>(anatomy.tubes.size()));
        ends.push_back(branch.spheres.back().p);
        leaves_.push_back(leaves_m);
        anatomy.tubes.push_back(std::move(tube));
      }
      for (const Part::Role& role : part.roles) {
        const auto nearest = std::min_element(ends.begin(), ends.end(), [&](const auto& a, const auto& b) {
          return (a - role.end).squaredNorm() < (b - role.end).squaredNorm();
        });
        if (nearest != ends.end())
          anatomy.tubes[first + static_cast<std::size_t>(nearest - ends.begin())].name = role.name;
      }
    }
  }

  int tube_named(const std::string& name) const {
    for (std::size_t t = 0; t < result_.anatomy.tubes.size(); ++t)
      if (result_.anatomy.tubes[t].name == name) return static_cast<int>(t);
    return -1;
  }

  void name(int tube, const std::string& name, double from_m, double to_m) {
    result_.anatomy.branches.push_back({name, tube, from_m, to_m});
  }

  /// Names of what leaves the aorta between root and diaphragm: from right to left, as they leave it.
  void name_arch() {
    std::vector<Tube>& tubes = result_.anatomy.tubes;
    const Tube& aorta = tubes[0];
    double top = 0;
    for (const TubeNode& node : aorta.nodes)
      if (node.s_m < 0.25 && node.p.y() > aorta.at(top).p.y()) top = node.s_m;
    std::vector<std::pair<double, int>> leaving;
    for (int t = 1; t < static_cast<int>(tubes.size()); ++t) {
      if (tubes[t].parent != 0 || !tubes[t].name.empty()) continue;
      const double s = nearest_s(aorta, tubes[t].nodes.front().p);
      if (std::fabs(s - top) < 60 * mm && tubes[t].nodes.back().p.y() > aorta.at(s).p.y()) leaving.push_back({s, t});
    }
    std::sort(leaving.begin(), leaving.end());
    // What leaves the arch is held by the neck.
    result_.anatomy.ascending_m = std::clamp(0.8 * (leaving.empty() ? top : leaving.front().first), 30 * mm, 75 * mm);
    const std::vector<const char*> names =
        leaving.size() == 3   ? std::vector<const char*>{"brachiocephalic", "left carotid", "left subclavian"}
        : leaving.size() == 2 ? std::vector<const char*>{"brachiocephalic", "left subclavian"}
                              : std::vector<const char*>{};
    for (std::size_t i = 0; i < names.size(); ++i) tubes[leaving[i].second].name = names[i];
    result_.notes.push_back(fmt::format("arch: its top is {:.0f} mm from the root; {} vessels leave it{}", top / mm,
                                        leaving.size(), names.empty() ? ", which stay numbers" : ""));
  }

  void name_aorta() {
    std::vector<Tube>& tubes = result_.anatomy.tubes;
    const Tube& aorta = tubes[0];
    int other = -1;
    double at = 0;
    for (int t = 1; t < static_cast<int>(tubes.size()); ++t) {
      if (tubes[t].parent != 0 || !tubes[t].name.empty() || tubes[t].length_m() < 40 * mm) continue;
      const double s = nearest_s(aorta, tubes[t].nodes.front().p);
      const double after = aorta.at(s + 25 * mm).radius_m, before = aorta.at(s - 15 * mm).radius_m;
      const double ratio = tubes[t].at(leaves_[t] + 15 * mm).radius_m / after;
      if (s > 0.2 && after < 0.8 * before && ratio > 0.55 && ratio < 1.8 && s > at) at = s, other = t;
    }
    if (other < 0) {
      name(0, "aorta", 0, aorta.length_m());
      return;
    }
    const bool own_is_right = aorta.nodes.back().p.x() < tubes[other].nodes.back().p.x();
    tubes[other].name = own_is_right ? "left iliac" : "right iliac";
    name(0, "aorta", 0, at);
    name(0, own_is_right ? "right iliac" : "left iliac", at, aorta.length_m());
  }

  void name_all() {
    std::vector<Tube>& tubes = result_.anatomy.tubes;
    if (has_aorta_) {
      name_arch();
      name_aorta();
    }
    int number = 0;
    const int lad = tube_named("LAD"), lcx = tube_named("LCx");
    for (int t = has_aorta_ ? 1 : 0; t < static_cast<int>(tubes.size()); ++t) {
      double from = leaves_[t];
      if (t == lad && lcx >= 0) {
        const double parting = std::clamp(nearest_s(tubes[t], tubes[lcx].nodes.front().p), from, tubes[t].length_m());
        name(t, "LM", from, parting);
        from = parting;
      }
      if (tubes[t].name.empty()) tubes[t].name = std::to_string(++number);
      name(t, tubes[t].name, from, tubes[t].length_m());
    }
    for (const auto& [found, wanted] : options_.names) {
      bool any = false;
      std::string all;
      for (NamedBranch& branch : result_.anatomy.branches) {
        all += (all.empty() ? "" : ", ") + branch.name;
        if (branch.name == found) branch.name = wanted, any = true;
      }
      if (!any)
        throw MeshError(fmt::format("there is no branch \"{}\" to be called {}; found: {}", found, wanted, all));
    }
  }

  void set_landmarks() {
    Landmarks& marks = result_.anatomy.landmarks;
    const Landmarks& mean = mean_.anatomy.landmarks;
    const std::vector<Tube>& tubes = result_.anatomy.tubes;
    const auto ostium = [&](const char* name, const Eigen::Vector3d& ours) {
      const auto found = ostium_.find(name);
      return found != ostium_.end() ? found->second : fit() * ours;
    };
    marks.p_left_ostium = ostium("LM", mean.p_left_ostium);
    marks.p_right_ostium = ostium("RCA", mean.p_right_ostium);
    marks.p_lv_base = fit() * mean.p_lv_base;
    marks.p_lv_apex = fit() * mean.p_lv_apex;
    marks.right_groove = fit().R * mean.right_groove;
    marks.p_annulus = fit() * mean.p_annulus;
    marks.root_axis = fit().R * mean.root_axis;
    if (has_aorta_) {
      marks.root_axis = tubes[0].tangent(8 * mm);
      // The tube begins where the widest sphere fits; the annulus lies before it.
      marks.p_annulus = tubes[0].nodes.front().p - 0.8 * tubes[0].nodes.front().radius_m * marks.root_axis;
    }
    int tube = 0;
    double s = has_aorta_ ? tubes[0].length_m() - std::min(20 * mm, 0.1 * tubes[0].length_m()) : 2 * mm;
    bool inwards = !has_aorta_;
    if (options_.entry) {
      const Eigen::Vector3d p = result_.R_PF * *options_.entry;
      double nearest = 1e9;
      for (int t = 0; t < static_cast<int>(tubes.size()); ++t) {
        const double at = nearest_s(tubes[t], p), d = (tubes[t].at(at).p - p).norm() - tubes[t].at(at).radius_m;
        if (d < nearest) nearest = d, tube = t, s = at;
      }
      inwards = tubes[tube].parent < 0 && !has_aorta_ && s < tubes[tube].length_m() / 2;
      if (nearest > 10 * mm)
        result_.notes.push_back(fmt::format("the entry asked for lies {:.0f} mm outside the lumen", nearest / mm));
    }
    // Not in the very tip.
    s = std::clamp(s, 1 * mm, std::max(1 * mm, tubes[tube].length_m() - 2 * tubes[tube].nodes.back().radius_m));
    marks.p_access = tubes[tube].at(s).p;
    marks.access_direction = (inwards ? 1 : -1) * tubes[tube].tangent(s);
  }

  void move_to_ostium() {
    const Eigen::Vector3d shift = result_.anatomy.landmarks.p_left_ostium;
    result_.shift_P = shift;
    Landmarks& m = result_.anatomy.landmarks;
    for (Eigen::Vector3d* p :
         {&m.p_access, &m.p_left_ostium, &m.p_right_ostium, &m.p_annulus, &m.p_lv_base, &m.p_lv_apex})
      *p -= shift;
    for (Tube& tube : result_.anatomy.tubes)
      for (TubeNode& node : tube.nodes) node.p -= shift;
    for (Eigen::Vector3d& p : result_.lumen.vertices) p -= shift;
  }

  const Mesh& lumen_;
  const RecogniseOptions& options_;
  const MeanCourses mean_;
  std::vector<Part> parts_;
  bool has_aorta_ = false;
  Course aorta_;
  Similarity aorta_fit_, heart_fit_;  ///< from the mean anatomy to the file's frame, turned later
  std::map<std::string, Eigen::Vector3d> ostium_;
  std::vector<double> leaves_;  ///< of each tube: arc length where it leaves its parent's wall
  Recognised result_;
};

}  // namespace

Recognised recognise(const Mesh& lumen, const RecogniseOptions& options) { return Recogniser(lumen, options).run(); }

}  // namespace ostium
