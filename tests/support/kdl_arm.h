#pragma once

#include <kdl/chain.hpp>

#include "core/device/arm_model.h"

namespace godobject::test {

inline KDL::Vector to_kdl(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

inline KDL::Frame to_kdl(const Pose& H) {
  const Quaternion& q = H.rotation;
  return {KDL::Rotation::Quaternion(q.x(), q.y(), q.z(), q.w()), to_kdl(H.translation)};
}

inline KDL::RigidBodyInertia to_kdl(const LinkMass& body) {
  const Matrix3& I = body.inertia;
  const KDL::RotationalInertia inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  return KDL::RigidBodyInertia(body.mass, to_kdl(body.com), inertia);
}

/// Returns the arm as a chain of Orocos KDL, made only from the numbers of `model`: base, two segments a joint, tool.
inline KDL::Chain make_chain(const ArmModel& model) {
  KDL::Chain chain;
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), to_kdl(model.H_RA)));
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints.at(static_cast<std::size_t>(i));
    const KDL::Frame before = KDL::Frame::DH_Craig1989(joint.a, joint.alpha, joint.d, joint.offset);
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), before));
    chain.addSegment(
        KDL::Segment(KDL::Joint(KDL::Joint::RotZ, 1, 0, joint.rotor), KDL::Frame::Identity(), to_kdl(joint.link)));
  }
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::Fixed), to_kdl(model.H_FM), to_kdl(model.payload)));
  return chain;
}

}  // namespace godobject::test
