#pragma once
/// A case on a page: its vessels in three dimensions, what an import mended, and everything that a person may change
/// (app/serve/workbench/README.md). Requests are heard on the server's thread and done one after another on the
/// owner's; what was refused changes nothing.
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

#include "app/serve/http/server.h"
#include "app/serve/workbench/draft_picture.h"
#include "data/catalogue/case/case_draft.h"
#include "vascular/anatomy/editing/lumen_gauge.h"

namespace ostium::app {

/// What the page may ask for that concerns files and programs. Each throws std::runtime_error with why not.
struct WorkbenchOwner {
  std::function<void(data::CaseDraft&)> save;                              ///< where it is from
  std::function<void(data::CaseDraft&, const std::string& name)> save_as;  ///< among the imported cases
  std::function<std::string(const data::CaseDraft&)> try_it;               ///< link of a session on it
  std::function<std::string(const std::string& file)> mends;               ///< JSON list; "": no import
};

class Workbench : public Listener {
 public:
  /// Throws std::runtime_error if the address cannot be listened at.
  Workbench(data::CaseDraft draft, WorkbenchOwner owner, const std::string& address, std::uint16_t port);

  std::string link() const;
  std::string viewer_link() const;

  const data::CaseDraft& draft() const { return draft_; }

  /// Does what is asked for, until the page closes the workbench or `stop`. Whether changes are left that were neither
  /// saved nor given up.
  bool work(const std::atomic<bool>& stop);

  // --- Listener, on the server's thread
  std::vector<std::string> greet(Role role) override;
  std::string hear(Role role, const std::string& text) override;
  void lost_trainer() override {}

 private:
  void obey(const data::CaseDraft::Json& order);
  bool change_case(const std::string& what, const data::CaseDraft::Json& order);
  bool change_course(const std::string& what, const data::CaseDraft::Json& order);
  void tell_draft();
  void tell_wall();
  void tell(const data::CaseDraft::Json& message);
  void tell_refused(const std::string& what, const std::string& why);
  std::optional<std::string> next(const std::atomic<bool>& stop);

  data::CaseDraft draft_;
  WorkbenchOwner owner_;
  std::string address_, token_, viewer_token_;
  std::optional<vascular::Mesh> healthy_;  ///< of an imported case: what its courses are measured by
  std::optional<vascular::LumenGauge> gauge_;
  DraftPicture picture_;
  int wall_of_ = -1;  ///< revision whose wall was told
  bool closed_ = false, given_up_ = false;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable asked_;
  std::deque<std::string> orders_;
  std::string told_;  ///< the draft, for those who come
  std::unique_ptr<Server> server_;
};

}  // namespace ostium::app
