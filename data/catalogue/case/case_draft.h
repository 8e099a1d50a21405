#pragma once
/// A case that is being edited: its file and, of an imported one, its vessels' courses. Each edit is checked as reading
/// the files would; one that is refused changes nothing, any other can be undone.
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "data/catalogue/case/case.h"
#include "data/formats/write_file.h"

namespace ostium::data {

class CaseDraft {
 public:
  using Json = nlohmann::ordered_json;
  using AnatomyEdit = std::function<vascular::Anatomy(vascular::Anatomy)>;

  /// By name, file or folder, as `find_case`. Throws LoadError.
  explicit CaseDraft(const std::string& name);

  const std::string& file() const { return file_; }
  const Case& now() const { return now_; }
  const Json& json() const { return steps_[at_].json; }  ///< the case's file as it would be written
  bool imported() const { return now_.imported != nullptr; }
  int revision() const { return revision_; }  ///< another one after every change

  // --- Edits. They throw LoadError or std::invalid_argument with what was wrong; `what` is how undo calls the step.
  /// A member of the file, "title" or "card.history".
  void set(const std::string& what, const std::string& key, const Json& value);
  void add_lesion(const Json& lesion);
  void change_lesion(std::size_t i, const Json& lesion);
  void remove_lesion(std::size_t i);
  /// Of an imported case. `names`: branches that it renames, found and wanted; lesions follow.
  void edit_anatomy(const std::string& what, const AnatomyEdit& edit,
                    const std::pair<std::string, std::string>& names = {});

  std::string undoes() const;  ///< what `undo` takes back; empty: nothing
  std::string redoes() const;
  void undo();  ///< nothing, if there is nothing
  void redo();
  bool changed() const { return at_ != saved_; }

  /// What the case consists of under another name, or its own, by file names without folder, but for the lumen's files.
  std::vector<FileText> texts(const std::string& name) const;
  /// Of an imported case: files that are taken over as they are.
  std::vector<std::string> lumen_files() const;
  void saved_as(const std::string& file);  ///< `texts` and the others have been written there

 private:
  struct Step {
    std::string what;
    Json json;
    vascular::Anatomy anatomy;  ///< of an imported case
  };
  void add(Step step);
  void become(std::size_t at);
  Case read(const Step& step) const;

  std::string file_;
  Case now_;
  std::vector<Step> steps_;
  std::size_t at_ = 0, saved_ = 0;
  int revision_ = 0;
};

}  // namespace ostium::data
