// The options that set a view.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "paim/cli/parse.h"
#include "player/view/view_state.h"

namespace paim::player {

// What the options change in a view, in any order.
using ViewChanges = std::vector<std::function<void(ViewState&)>>;

class ViewOptions {
  public:
    explicit ViewOptions(CLI::App& app);  // adds them
    ~ViewOptions();

    // What was given. Error (usage) that names the option for values out of range.
    ViewChanges changes() const;
    // Whether the exposure is to be chosen ("--exposure auto").
    bool auto_exposure() const;

  private:
    struct Raw;
    std::unique_ptr<Raw> raw_;
};

}  // namespace paim::player
