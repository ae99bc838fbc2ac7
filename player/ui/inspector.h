// What the panels show of the view beyond its numbers: balls of the light, lobes, the picked vertex and its
// error over time, and where marked vertices are seen.
#pragma once

#include <memory>
#include <optional>

#include "player/session.h"
#include "player/ui/globe_view.h"
#include "player/ui/lobe_view.h"
#include "player/ui/panels.h"
#include "player/vertex_probe.h"

namespace paim::player {

class Inspector {
  public:
    // Measures some poses of the history of the picked vertex, a few milliseconds a call. Returns whether it
    // did.
    bool advance(Session& session);
    // Whether there are poses left to measure.
    bool is_measuring() const;

    // Fills in what belongs to open sections of the panels. The pictures are valid until the next call.
    // aspect  of the window
    void describe(Session& session, const PanelState& state, float aspect, PanelInfo& info);

  private:
    void describe_light(Session& session, PanelInfo& info);
    void describe_surface(Session& session, float aspect, PanelInfo& info);
    void describe_picked(Session& session, float aspect, PanelInfo& info);

    GlobeView globe_;
    std::optional<LobeView> coefficient_lobe_, picked_lobe_;
    std::unique_ptr<ErrorHistory> history_;
};

}  // namespace paim::player
