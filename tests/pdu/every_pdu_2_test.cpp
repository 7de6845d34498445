// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/pdu/support/every_pdu.hpp"

namespace reckon::pdu {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(Share2, EveryPdu, Share<1>, PduNames);

}  // namespace
}  // namespace reckon::pdu
