// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/udp_send_batch.hpp"

#include <netinet/udp.h>

#include <algorithm>
#include <cassert>
#include <cstring>

#include "reckon/peer/network/udp_socket.hpp"

namespace reckon::peer {

std::size_t segment_run(std::span<const OutgoingDatagram> batch, std::size_t max_payload) noexcept {
  const std::size_t length = batch.front().bytes.size();
  if (length == 0 || length > max_payload) return 1;
  const std::size_t most = std::min({batch.size(), kMostSegments, kMostSegmented / length});
  std::size_t count = 1;
  while (count < most && batch[count].to == batch.front().to) {
    const std::size_t next = batch[count].bytes.size();
    if (next == 0 || next > length) break;
    ++count;
    if (next < length) break;
  }
  return count;
}

void UdpSendBatch::plan(std::span<const OutgoingDatagram> batch, std::size_t max_payload,
                        unsigned interface_index) noexcept {
  assert(batch.size() <= kMaxBatch);
  batch_ = batch;
  count_ = 0;
  for (std::size_t first = 0; first < batch.size();) {
    const std::size_t count = max_payload == 0 ? 1 : segment_run(batch.subspan(first), max_payload);
    add(first, count, interface_index);
    first += count;
  }
  first_[count_] = batch.size();
}

void UdpSendBatch::add(std::size_t first, std::size_t count, unsigned interface_index) noexcept {
  first_[count_] = first;
  for (std::size_t i = first; i < first + count; ++i) {
    // sendmsg only reads.
    vectors_[i] = {const_cast<std::byte*>(batch_[i].bytes.data()), batch_[i].bytes.size()};
  }
  msghdr& header = messages_[count_].msg_hdr;
  header = {};
  header.msg_name = &addresses_[count_];
  header.msg_namelen = to_sockaddr(batch_[first].to, interface_index, addresses_[count_]);
  header.msg_iov = &vectors_[first];
  header.msg_iovlen = count;
  if (count > 1) {
    Control& control = controls_[count_];
    header.msg_control = control.bytes.data();
    header.msg_controllen = control.bytes.size();
    cmsghdr* segment = CMSG_FIRSTHDR(&header);
    segment->cmsg_level = SOL_UDP;
    segment->cmsg_type = UDP_SEGMENT;
    segment->cmsg_len = CMSG_LEN(sizeof(std::uint16_t));
    const auto length = static_cast<std::uint16_t>(batch_[first].bytes.size());
    std::memcpy(CMSG_DATA(segment), &length, sizeof length);
  }
  ++count_;
}

}  // namespace reckon::peer
