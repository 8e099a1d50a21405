#include "vascular/anatomy/labelling/heart_match.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/anatomy/labelling/coronary_trunks.h"
#include "vascular/anatomy/labelling/recognition.h"

namespace ostium::vascular {

namespace {

using units::mm, units::degree;
constexpr double worst_score_m = 25 * mm;  // with what counts against a fit besides its distance
constexpr double least_of_mean = 0.35;     // of an artery's length: a short piece bends like many others

struct HeartFit {
  Similarity fit;
  double score = 1e9;
  int left = -1, right = -1;  ///< indices of trunks
  std::size_t lad = 0, lcx = 0, rca = 0;
  bool circumflex = false;
};

struct HeartTrunks {
  const MeanCourses& mean;
  const AortaMatch* aorta;
  const std::vector<Trunk>& trunks;
};

void add_pairs(const Course& ours, const Course& theirs, std::vector<Eigen::Vector3d>& from,
               std::vector<Eigen::Vector3d>& to) {
  std::vector<Eigen::Vector3d> a = ours.points(0, labelling_step_m, 0.11), b = theirs.points(0, labelling_step_m, 0.11);
  const std::size_t n = std::min(a.size(), b.size());
  from.insert(from.end(), a.begin(), a.begin() + static_cast<long>(n));
  to.insert(to.end(), b.begin(), b.begin() + static_cast<long>(n));
}

void try_fit(const HeartTrunks& known, HeartFit candidate, HeartFit& best) {
  std::vector<Eigen::Vector3d> from, to;
  double unused = 0;
  const auto add = [&](const Course& ours, int trunk, std::size_t end) {
    const std::vector<Course>& all = known.trunks[static_cast<std::size_t>(trunk)].courses;
    double longest = 0;
    for (const Course& course : all) longest = std::max(longest, course.length_m());
    unused += longest - all[end].length_m();
    add_pairs(ours, all[end], from, to);
  };
  if (candidate.left >= 0) add(known.mean.lad, candidate.left, candidate.lad);
  if (candidate.circumflex) add(known.mean.lcx, candidate.left, candidate.lcx);
  if (candidate.right >= 0) add(known.mean.rca, candidate.right, candidate.rca);
  if (from.size() < 8) return;
  candidate.fit = nearest_similarity(from, to);
  if (candidate.fit.scale < 0.6 || candidate.fit.scale > 1.6) return;
  candidate.score = candidate.fit.rms_m + 0.05 * unused;
  if (known.aorta) {
    const double turn = Eigen::AngleAxisd(candidate.fit.R * known.aorta->fit.R.transpose()).angle();
    candidate.score += 0.2 * mm * std::max(0.0, turn / degree - 20);
  }
  // Penalty for ostia far from where the aorta's fit puts them.
  const auto misplaced = [&](int trunk, const Eigen::Vector3d& ostium) {
    const double off = (known.trunks[trunk].courses[0].spheres.front().p - known.aorta->fit * ostium).norm();
    candidate.score += 0.3 * std::max(0.0, off - 20 * mm);
  };
  if (known.aorta && candidate.left >= 0) misplaced(candidate.left, known.mean.anatomy.landmarks.p_left_ostium);
  if (known.aorta && candidate.right >= 0) misplaced(candidate.right, known.mean.anatomy.landmarks.p_right_ostium);
  // Prefer matches with more arteries.
  candidate.score += (candidate.left < 0 || candidate.right < 0 ? 10 * mm : 0) + (candidate.circumflex ? 0 : 5 * mm);
  if (candidate.score < best.score) best = candidate;
}

/// Tries all pairs of trunks and their ends.
HeartFit best_fit(const HeartTrunks& known) {
  const std::vector<Trunk>& trunks = known.trunks;
  HeartFit best;
  const int n = static_cast<int>(trunks.size());
  for (int left = -1; left < n; ++left)
    for (int right = -1; right < n; ++right) {
      if (left == right) continue;
      if (left >= 0 && right >= 0 && trunks[left].part == trunks[right].part &&
          !(known.aorta && trunks[left].part == 0))
        continue;
      const std::size_t rights = right < 0 ? 1 : trunks[right].ends.size();
      const std::size_t lefts = left < 0 ? 1 : trunks[left].ends.size();
      for (std::size_t rca = 0; rca < rights; ++rca)
        for (std::size_t lad = 0; lad < lefts; ++lad) {
          try_fit(known, {.fit = {}, .left = left, .right = right, .lad = lad, .rca = rca}, best);
          for (std::size_t lcx = 0; left >= 0 && lcx < lefts; ++lcx) {
            if (lcx == lad || trunks[left].courses[lad].parts_from(trunks[left].courses[lcx]) > 45 * mm) continue;
            try_fit(known,
                    {.fit = {}, .left = left, .right = right, .lad = lad, .lcx = lcx, .rca = rca, .circumflex = true},
                    best);
          }
        }
    }
  return best;
}

/// Finds a circumflex that did not match the mean but is nearer to it than all other courses.
void find_circumflex(const MeanCourses& mean, const Trunk& left, HeartFit& best) {
  double nearest = 25 * mm;
  for (std::size_t c = 0; c < left.courses.size(); ++c) {
    if (c == best.lad || left.courses[best.lad].parts_from(left.courses[c]) > 45 * mm) continue;
    std::vector<Eigen::Vector3d> ours, theirs;
    add_pairs(mean.lcx, left.courses[c], ours, theirs);
    double sum = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) sum += (best.fit * ours[i] - theirs[i]).squaredNorm();
    const double off = std::sqrt(sum / static_cast<double>(ours.size()));
    if (off < nearest) nearest = off, best.lcx = c, best.circumflex = true;
  }
}

/// By all arteries that were found, which the fit itself may have left out; too short ones are no evidence.
double doubt_of(const HeartFit& best, const HeartTrunks& known) {
  std::vector<Eigen::Vector3d> from, to;
  const auto course = [&](int trunk, std::size_t end) -> const Course& {
    return known.trunks[static_cast<std::size_t>(trunk)].courses[end];
  };
  if (best.left >= 0) add_pairs(known.mean.lad, course(best.left, best.lad), from, to);
  if (best.circumflex) add_pairs(known.mean.lcx, course(best.left, best.lcx), from, to);
  if (best.right >= 0) add_pairs(known.mean.rca, course(best.right, best.rca), from, to);
  const Similarity fit = nearest_similarity(from, to);
  const auto whole = [&](const Course& ours, int trunk, std::size_t end) {
    return course(trunk, end).length_m() > least_of_mean * fit.scale * ours.length_m();
  };
  const bool left = best.left >= 0 && whole(known.mean.lad, best.left, best.lad);
  const double doubt =
      heart_doubt(fit, {.left = left,
                        .circumflex = left && best.circumflex && whole(known.mean.lcx, best.left, best.lcx),
                        .right = best.right >= 0 && whole(known.mean.rca, best.right, best.rca),
                        .aorta = known.aorta && known.aorta->arch});
  return std::max(doubt, best.score / worst_score_m);
}

}  // namespace

std::optional<HeartMatch> match_heart(std::vector<LumenPart>& parts, const AortaMatch* aorta, const MeanCourses& mean,
                                      bool assumed, std::vector<std::string>& notes) {
  const std::vector<Trunk> trunks = coronary_trunks(parts, aorta);
  HeartFit best = best_fit({mean, aorta, trunks});
  if (best.left < 0 && best.right < 0) return std::nullopt;
  if (best.left >= 0 && !best.circumflex) find_circumflex(mean, trunks[static_cast<std::size_t>(best.left)], best);
  HeartMatch match{.fit = best.fit, .ostia = {}, .doubt = doubt_of(best, {mean, aorta, trunks})};
  if (match.doubt >= 1 && !assumed) return match;
  if (best.left >= 0) {
    const Trunk& left = trunks[best.left];
    parts[left.part].root = left.root;
    parts[left.part].roles.push_back({left.ends[best.lad], "LAD"});
    if (best.circumflex) parts[left.part].roles.push_back({left.ends[best.lcx], "LCx"});
    match.ostia["LM"] = left.courses[best.lad].spheres.front().p;
  }
  if (best.right >= 0) {
    const Trunk& right = trunks[best.right];
    parts[right.part].root = right.root;
    parts[right.part].roles.push_back({right.ends[best.rca], "RCA"});
    match.ostia["RCA"] = right.courses[best.rca].spheres.front().p;
  }
  if (best.left < 0) notes.push_back("no left coronary artery was recognised");
  if (best.right < 0) notes.push_back("no right coronary artery was recognised");
  return match;
}

}  // namespace ostium::vascular
