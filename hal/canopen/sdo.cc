#include "hal/canopen/sdo.h"

#include "hal/canopen/little_endian.h"
#include "hal/canopen/network.h"

namespace godobject::hal::canopen {
namespace {

// command specifiers: the upper three bits of byte 0
constexpr int kClientDownloadSegment = 0;
constexpr int kClientDownload = 1;
constexpr int kClientBlockDownload = 6;
constexpr int kServerUpload = 2;
constexpr int kServerDownload = 3;
constexpr int kAbort = 4;

constexpr std::uint8_t kExpedited = 0x02;
constexpr std::uint8_t kSizeIsTold = 0x01;

CanFrame request(int node, std::uint8_t command, std::uint16_t index, std::uint8_t subindex) noexcept {
  CanFrame frame{cob(kCobSdoRequest, node), 8};
  frame.data[0] = command;
  store(frame.data, 1, 2, index);
  frame.data[3] = subindex;
  return frame;
}

}  // namespace

CanFrame sdo_read(int node, std::uint16_t index, std::uint8_t subindex) noexcept {
  return request(node, 0x40, index, subindex);
}

CanFrame sdo_write(int node, std::uint16_t index, std::uint8_t subindex, std::uint32_t value, int size) noexcept {
  const auto command = static_cast<std::uint8_t>(kClientDownload << 5 | (4 - size) << 2 | kExpedited | kSizeIsTold);
  CanFrame frame = request(node, command, index, subindex);
  store(frame.data, 4, static_cast<std::size_t>(size), value);
  return frame;
}

bool parse_sdo_response(const CanFrame& frame, SdoResponse& response) noexcept {
  const int node = node_of(frame.id, kCobSdoResponse);
  if (node == 0 || frame.length != 8) return false;
  response = SdoResponse();
  response.node = node;
  response.index = static_cast<std::uint16_t>(load(frame.data, 1, 2));
  response.subindex = frame.data[3];
  const std::uint8_t command = frame.data[0];
  switch (command >> 5) {
    case kServerUpload:
      if ((command & kExpedited) == 0) {
        response.kind = SdoResponse::Kind::kLong;
        return true;
      }
      response.kind = SdoResponse::Kind::kRead;
      response.size = (command & kSizeIsTold) != 0 ? 4 - (command >> 2 & 3) : 0;
      response.value = load(frame.data, 4, response.size == 0 ? 4 : static_cast<std::size_t>(response.size));
      return true;
    case kServerDownload: response.kind = SdoResponse::Kind::kWritten; return true;
    case kAbort:
      response.kind = SdoResponse::Kind::kAborted;
      response.value = load(frame.data, 4, 4);
      return true;
    default: response.kind = SdoResponse::Kind::kLong; return true;
  }
}

bool is_sdo_write(const CanFrame& frame) noexcept {
  if (node_of(frame.id, kCobSdoRequest) == 0 || frame.length == 0) return false;
  const int wanted = frame.data[0] >> 5;
  return wanted == kClientDownload || wanted == kClientDownloadSegment || wanted == kClientBlockDownload;
}

}  // namespace godobject::hal::canopen
