// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device node simulated by umockdev: a program's requests go to a model.
#pragma once

#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <umockdev.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace reckon::test {

/// Only under umockdev-wrapper. A thread of its own answers while the caller waits: between two
/// calls nothing else reads or changes the model.
class MockedNode {
 public:
  MockedNode(const MockedNode&) = delete;
  MockedNode& operator=(const MockedNode&) = delete;

 protected:
  /// @param node such as "hidraw3", below /dev
  /// @param subsystem, path as in /sys
  MockedNode(const std::string& node, const std::string& subsystem, const std::string& path)
      : path_("/dev/" + node), bed_(umockdev_testbed_new()), base_(umockdev_ioctl_base_new()) {
    g_signal_connect(base_.get(), "handle-ioctl", G_CALLBACK(on_ioctl), this);
    g_signal_connect(base_.get(), "handle-read", G_CALLBACK(on_read), this);
    g_signal_connect(base_.get(), "handle-write", G_CALLBACK(on_write), this);
    const std::string text = "P: " + path + "\nN: " + node + "\nE: DEVNAME=" + path_ +
                             "\nE: SUBSYSTEM=" + subsystem + "\n\n";
    EXPECT_TRUE(umockdev_testbed_add_from_string(bed_.get(), text.c_str(), nullptr));
    EXPECT_TRUE(umockdev_testbed_attach_ioctl(bed_.get(), path_.c_str(), base_.get(), nullptr));
  }
  virtual ~MockedNode() { umockdev_testbed_detach_ioctl(bed_.get(), path_.c_str(), nullptr); }

  using Octets = std::vector<std::uint8_t>;

  /// The argument of an ioctl.
  class Request {
   public:
    explicit Request(UMockdevIoctlClient* client)
        : argument_(umockdev_ioctl_client_get_arg(client)) {
      // Sign-extended by umockdev if its top bit is set.
      number_ = static_cast<std::uint32_t>(umockdev_ioctl_client_get_request(client));
    }
    /// The same except for its size.
    [[nodiscard]] bool is(unsigned long other) const {
      return ((number_ ^ other) & ~std::uint32_t{IOCSIZE_MASK} & 0xffffffff) == 0;
    }
    [[nodiscard]] std::size_t size() const { return _IOC_SIZE(number_); }
    /// Of a request whose argument is not an address.
    [[nodiscard]] std::uint64_t value() const {
      std::uint64_t out = 0;
      std::memcpy(&out, argument_->data, sizeof out);
      return out;
    }
    /// The octets at the passed address.
    [[nodiscard]] Octets octets() const {
      const UMockdevIoctlData* const data = resolve();
      return {data->data, data->data + size()};
    }
    /// Writes there as many as fit. @returns their number.
    long give(Octets octets) const {
      octets.resize(std::min(octets.size(), size()));
      umockdev_ioctl_data_update(resolve(), 0, octets.data(), static_cast<int>(octets.size()));
      return static_cast<long>(octets.size());
    }

   private:
    [[nodiscard]] UMockdevIoctlData* resolve() const {
      return umockdev_ioctl_data_resolve(argument_, 0, static_cast<int>(size()), nullptr);
    }

    std::uint32_t number_;
    UMockdevIoctlData* argument_;
  };

  // Each returns the result of the call, or a negative error number.
  virtual long control(const Request& request) = 0;
  virtual long write(std::span<const std::uint8_t> octets) = 0;
  /// @param octets the octets read; empty if it fails
  virtual long read(Octets& octets) = 0;

 private:
  struct Unref {
    template <class T>
    void operator()(T* object) const {
      g_object_unref(object);
    }
  };

  static void complete(UMockdevIoctlClient* client, long result) {
    umockdev_ioctl_client_complete(client, result < 0 ? -1 : result,
                                   result < 0 ? static_cast<int>(-result) : 0);
  }
  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    complete(client, static_cast<MockedNode*>(self)->control(Request(client)));
    return TRUE;
  }
  static gboolean on_write(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    const UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
    const auto size = static_cast<std::size_t>(data->data_len);
    complete(client, static_cast<MockedNode*>(self)->write({data->data, size}));
    return TRUE;
  }
  static gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
    Octets octets;
    const long result = static_cast<MockedNode*>(self)->read(octets);
    umockdev_ioctl_data_update(umockdev_ioctl_client_get_arg(client), 0, octets.data(),
                               static_cast<int>(octets.size()));
    complete(client, result);
    return TRUE;
  }

  std::string path_;
  std::unique_ptr<UMockdevTestbed, Unref> bed_;
  std::unique_ptr<UMockdevIoctlBase, Unref> base_;
};

}  // namespace reckon::test
