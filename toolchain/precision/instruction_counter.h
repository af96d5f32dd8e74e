#pragma once

namespace godobject::precision {

/// Counts the instructions that this thread retires in user mode, with the processor's own counter (perf_event_open).
/// Many virtual machines have none, and a system may forbid it. Then every count is NaN.
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  void start();
  double stop();  ///< since `start`

 private:
  int descriptor_ = -1;
};

}  // namespace godobject::precision
