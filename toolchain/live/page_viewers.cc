#include "toolchain/live/page_viewers.h"

#include <variant>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace godobject::live {
namespace {

ServerMessages page_answer(bool ok, const std::string& text) {
  const nlohmann::json answer{{"type", "answer"}, {"ok", ok}, {"text", text}};
  return {{answer.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)}};
}

}  // namespace

PageViewers::PageViewers(LiveSource& source, hal::Clock& clock)
    : source_(source), clock_(clock), message_(source.scene(), source.placement()) {}

void PageViewers::make_state(std::size_t viewers) {
  text_ = message_.text(source_.settings(), source_.speed(), source_.lost());
  viewers_ = viewers;
  if (holder_ != 0 && clock_.now_ns() - held_ns_ > kPatience_ns) holder_ = 0;
}

ServerMessages PageViewers::joined(ViewerNumber viewer) { return text_.empty() ? ServerMessages{} : state(viewer); }

ServerMessages PageViewers::state(ViewerNumber viewer) {
  const char* const hand = holder_ == 0 ? "free" : holder_ == viewer ? "yours" : "other";
  return {{fmt::format("{},\"hand\":\"{}\",\"viewers\":{}}}", text_, hand, viewers_)}};
}

std::optional<ServerMessages> PageViewers::received(ViewerNumber viewer, std::string_view message, bool binary) {
  if (binary) return {};
  const auto request = read_request(message);
  if (const auto* error = std::get_if<std::string>(&request)) return page_answer(false, *error);
  return carry_out(viewer, std::get<Request>(request));
}

/// The first viewer that moves the hand has it until it releases the hand, leaves or falls silent.
ServerMessages PageViewers::carry_out(ViewerNumber viewer, const Request& request) {
  const bool of_hand = std::holds_alternative<HandRequest>(request);
  if (of_hand && holder_ != 0 && holder_ != viewer) return page_answer(false, "another viewer has the hand");
  const std::string why_not = source_.answer(request);
  if (!why_not.empty()) return page_answer(false, why_not);
  if (of_hand) {
    holder_ = viewer;
    held_ns_ = clock_.now_ns();
  }
  if (std::holds_alternative<ReleaseRequest>(request)) left(viewer);
  return of_hand ? ServerMessages{} : page_answer(true, "");
}

void PageViewers::left(ViewerNumber viewer) {
  if (holder_ == viewer) holder_ = 0;
}

}  // namespace godobject::live
