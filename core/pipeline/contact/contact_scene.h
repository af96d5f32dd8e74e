#pragma once

#include <algorithm>

#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/edges/near_edges.h"
#include "core/pipeline/contact/feature_contacts.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/cycle/scene_traits.h"

namespace godobject {

/// The constants of a session of `contact`: the two bodies, and the lengths that depend only on them.
template <DistanceField Field, DistanceField BodyField>
struct ContactScene {
  const Field* field = nullptr;         ///< the still body's, in W
  const Pointshell* shell = nullptr;    ///< the moving body's sample points, in S
  FeatureContacts<BodyField> features;  ///< the second direction
  EdgeContacts edges;                   ///< edge against edge
  const Parameters* parameters = nullptr;
  ContactLengths lengths;
  ContactFriction friction;
  detail::FeatureDirection feature_direction;
  double longest_search_radius{};  ///< up to this displacement both fields tell near points from others [m]
  double free_clearance{};         ///< a motion along which every clearance stays above this is free [m]

  ContactScene() noexcept = default;

  /// All references must outlive the scene.
  ContactScene(const Field& still, const Pointshell& points, const FeatureContacts<BodyField>& second,
               const Parameters& q, const EdgeContacts& sharp = {}) noexcept
      : field(&still),
        shell(&points),
        features(second),
        edges(sharp),
        parameters(&q),
        lengths(ContactLengths::make(q)),
        friction{q.friction.static_ratio, q.friction.kinetic_ratio,
                 q.friction.viscous / (q.stiffness * q.coupling_translation * q.period)},
        feature_direction(lengths, second.body_radius),
        longest_search_radius(std::min(lengths.longest_search_radius, still.assured_clearance())) {
    if constexpr (kHasSecondDirection<BodyField>) {
      if (features.map != nullptr) {
        longest_search_radius =
            std::min(longest_search_radius, features.map->assured_clearance() / feature_direction.most_stretch());
      }
    }
    // larger gaps do not constrain a motion that stays clear of them, and the report does not contain them
    free_clearance = std::min(std::max(lengths.margin, lengths.shortest_search_radius), longest_search_radius);
  }

  bool has_features() const noexcept {
    if constexpr (kHasSecondDirection<BodyField>) return features.map != nullptr;
    return false;
  }

  bool has_edges() const noexcept {
    if constexpr (kSceneTraits.edges) return !edges.empty();
    return false;
  }
};

}  // namespace godobject
