#include "data/catalogue/case/case_draft.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/case/tree_file.h"
#include "data/formats/read_file.h"
#include "vascular/patient/patient_tree.h"

namespace ostium::data {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_steps = 500;  // that can be undone

}  // namespace

CaseDraft::CaseDraft(const std::string& name) : file_(fs::absolute(case_file(name)).string()), now_(load_case(file_)) {
  Step first{.what = "", .json = Json::parse(read_file(file_, "a case")), .anatomy = {}};
  if (now_.imported) first.anatomy = now_.imported->anatomy;
  steps_.push_back(std::move(first));
}

Case CaseDraft::read(const Step& step) const {
  std::shared_ptr<ImportedVessels> vessels;
  if (now_.imported) {
    vessels = std::make_shared<ImportedVessels>(*now_.imported);
    vessels->anatomy = step.anatomy;
  }
  return read_case(file_, step.json.dump(2), vessels);
}

void CaseDraft::add(Step step) {
  now_ = read(step);
  if (saved_ > at_) saved_ = std::string::npos;  // what was saved cannot be come back to
  steps_.resize(at_ + 1);
  steps_.push_back(std::move(step));
  if (steps_.size() > most_steps) {
    steps_.erase(steps_.begin());
    if (saved_ != std::string::npos) saved_ = saved_ == 0 ? std::string::npos : saved_ - 1;
  }
  at_ = steps_.size() - 1;
  ++revision_;
}

void CaseDraft::set(const std::string& what, const std::string& key, const Json& value) {
  Step step{what, json(), steps_[at_].anatomy};
  Json* at = &step.json;
  for (std::size_t from = 0; from <= key.size();) {
    const std::size_t dot = std::min(key.find('.', from), key.size());
    at = &(*at)[key.substr(from, dot - from)];
    from = dot + 1;
  }
  if (*at == value) return;
  *at = value;
  add(std::move(step));
}

void CaseDraft::add_lesion(const Json& lesion) {
  Step step{"add a lesion", json(), steps_[at_].anatomy};
  step.json["lesions"].push_back(lesion);
  add(std::move(step));
}

void CaseDraft::change_lesion(std::size_t i, const Json& lesion) {
  Step step{"change a lesion", json(), steps_[at_].anatomy};
  if (i >= step.json["lesions"].size())
    throw std::invalid_argument(fmt::format("there is no lesion {}; the case has {}", i + 1, now_.lesions.size()));
  if (step.json["lesions"][i] == lesion) return;
  step.json["lesions"][i] = lesion;
  add(std::move(step));
}

void CaseDraft::remove_lesion(std::size_t i) {
  Step step{"remove a lesion", json(), steps_[at_].anatomy};
  if (i >= step.json["lesions"].size())
    throw std::invalid_argument(fmt::format("there is no lesion {}; the case has {}", i + 1, now_.lesions.size()));
  step.json["lesions"].erase(i);
  add(std::move(step));
}

void CaseDraft::edit_anatomy(const std::string& what, const AnatomyEdit& edit,
                             const std::pair<std::string, std::string>& names) {
  if (!now_.imported)
    throw std::invalid_argument(
        "this case's vessels are drawn by person, not imported; expected a change of "
        "lesions, or of the person");
  Step step{what, json(), edit(steps_[at_].anatomy)};
  for (Json& lesion : step.json["lesions"])
    for (const char* key : {"branch", "at_branch"})
      if (lesion.contains(key) && lesion[key] == names.first) lesion[key] = names.second;
  add(std::move(step));
}

std::string CaseDraft::undoes() const { return at_ > 0 ? steps_[at_].what : ""; }
std::string CaseDraft::redoes() const { return at_ + 1 < steps_.size() ? steps_[at_ + 1].what : ""; }

void CaseDraft::become(std::size_t at) {
  now_ = read(steps_[at]);
  at_ = at;
  ++revision_;
}
void CaseDraft::undo() {
  if (at_ > 0) become(at_ - 1);
}
void CaseDraft::redo() {
  if (at_ + 1 < steps_.size()) become(at_ + 1);
}

std::vector<FileText> CaseDraft::texts(const std::string& name) const {
  Json of_name = json();
  of_name["name"] = name;
  std::vector<FileText> out = {{name + ".json", of_name.dump(2) + "\n"}};
  if (!now_.imported) return out;
  const vascular::SphereTree tree = tree_of(now_.imported->anatomy, now_.lesions, now_.imported->lumen);
  out.push_back({of_name["imported"]["anatomy"], anatomy_to_json(now_.imported->anatomy)});
  out.push_back({"tree.json", tree_to_json(tree)});
  out.push_back({"tree.vtp", tree_to_vtp(tree)});
  return out;
}

std::vector<std::string> CaseDraft::lumen_files() const {
  std::vector<std::string> out;
  if (!now_.imported) return out;
  const Json& imported = json()["imported"];
  out.push_back(imported["lumen"]);
  if (imported.contains("frames"))
    for (const Json& frame : imported["frames"]) out.push_back(frame);
  return out;
}

void CaseDraft::saved_as(const std::string& file) {
  file_ = file;
  const std::string name = fs::path(file).stem().string();
  for (Step& step : steps_) step.json["name"] = name;
  now_.name = name;
  saved_ = at_;
}

}  // namespace ostium::data
