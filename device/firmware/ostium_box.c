#include "ostium_box.h"

#include <string.h>

enum { VERSION = 1, IN_TYPE = 0x01, OUT_TYPE = 0x81, BRAKE_TYPE = 0x82, KEY = 0x5443, LAST_TOOL = 4 };

static void put16(uint8_t* at, uint16_t v) { at[0] = (uint8_t)v, at[1] = (uint8_t)(v >> 8); }
static void put32(uint8_t* at, uint32_t v) { put16(at, (uint16_t)v), put16(at + 2, (uint16_t)(v >> 16)); }
static uint16_t get16(const uint8_t* at) { return (uint16_t)(at[0] | at[1] << 8); }
static uint32_t get32(const uint8_t* at) { return get16(at) | (uint32_t)get16(at + 2) << 16; }
static int32_t less(int32_t a, int32_t b) { return (int32_t)((uint32_t)a - (uint32_t)b); }

/* --- the calibration record: bits of IEEE floats are looked at, not computed with --------------------------------- */

static uint32_t crc32_of(const uint8_t* bytes, size_t count) {
  uint32_t crc = 0xffffffffu;
  while (count--) {
    crc ^= *bytes++;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

static int finite_at(const uint8_t* at) { return (get32(at) & 0x7f800000u) != 0x7f800000u; }
static int zero_at(const uint8_t* at) { return (get32(at) & 0x7fffffffu) == 0; }
static int negative_at(const uint8_t* at) { return (get32(at) >> 31) && !zero_at(at); }

static int record_is_valid(const uint8_t* r) {
  int at, k;
  if (memcmp(r, "OSTC", 4) != 0 || get16(r + 4) != 1 || get16(r + 6) != BOX_RECORD_BYTES) return 0;
  if (get32(r + 124) != crc32_of(r, 124)) return 0;
  for (at = 8; at < 24 && r[at]; ++at)
    if (r[at] <= ' ' || r[at] > '~') return 0;
  for (; at < 24; ++at)
    if (r[at]) return 0;
  for (at = 28; at < 124; at += 4)
    if (!finite_at(r + at)) return 0;
  for (k = 0; k < BOX_TRACKS; ++k) {
    const uint8_t* track = r + 28 + 16 * k;
    const uint8_t* full_scale = r + 108 + 4 * k;
    if (zero_at(track) || zero_at(track + 4) || negative_at(track + 12)) return 0;
    if (zero_at(full_scale) || negative_at(full_scale)) return 0;
  }
  return !zero_at(r + 92) && !zero_at(r + 100);
}

/* --- safety ---------------------------------------------------------------------------------------------------------
 */

void box_init(struct box* box, const uint8_t* record) {
  memset(box, 0, sizeof *box);
  memcpy(box->record, record, BOX_RECORD_BYTES);
  box->calibrated = (uint8_t)record_is_valid(record);
  box->rate_hz = 1000, box->watchdog_ms = 50;
}

void box_release(struct box* box) {
  memset(box->clamp, 0, sizeof box->clamp);
  memset(box->rotary, 0, sizeof box->rotary);
  box->armed = box->arm_was_low = 0;
}

uint16_t box_clamp(const struct box* box, int track) { return box->armed ? box->clamp[track] : 0; }
uint16_t box_rotary_clamp(const struct box* box, int track) { return box->armed ? box->rotary[track] : 0; }

/* --- reports --------------------------------------------------------------------------------------------------------
 */

void box_sample(struct box* box, const struct box_sensors* s, uint32_t now_us, uint8_t report[BOX_IN_BYTES]) {
  int k;
  uint32_t age_ms;
  box->now_us = now_us;
  ++box->sequence, ++box->sent;
  box->stopped = s->emergency_stop || s->over_temperature;
  if (box->stopped) box_release(box);
  if (box->armed && now_us - box->last_out_us >= 1000u * box->watchdog_ms) {
    box_release(box);
    box->watchdog_released = 1;
    ++box->releases;
  }
  memset(report, 0, BOX_IN_BYTES);
  report[0] = IN_TYPE, report[1] = VERSION;
  put16(report + 2, (uint16_t)(box->armed | box->watchdog_released << 1 | (s->emergency_stop != 0) << 2 |
                               (s->over_temperature != 0) << 3 | box->calibrated << 4));
  put32(report + 4, box->sequence);
  put32(report + 8, now_us);
  put16(report + 12, box->overruns);
  put16(report + 14, box->last_out_sequence);
  for (k = 0; k < BOX_TRACKS; ++k) {
    box->insertion[k] = s->insertion[k], box->roll[k] = s->roll[k];
    put32(report + 16 + 4 * k, (uint32_t)less(s->insertion[k], box->zero_insertion[k]));
    put32(report + 32 + 4 * k, (uint32_t)less(s->roll[k], box->zero_roll[k]));
    report[48 + k] = s->quality[k];
    report[52 + k] = s->tool[k] <= LAST_TOOL ? s->tool[k] : 0;
  }
  put16(report + 56, (uint16_t)s->pressure);
  put16(report + 58, (uint16_t)s->flow);
  put16(report + 60, s->pedals);
  age_ms = box->any_out ? (now_us - box->last_out_us) / 1000 : 65535;
  put16(report + 62, (uint16_t)(age_ms < 65535 ? age_ms : 65535));
}

void box_take(struct box* box, const uint8_t* b, size_t count) {
  int k;
  const int brakes = box->separate_brakes && count == BOX_BRAKE_BYTES && b[0] == BRAKE_TYPE;
  const int valid = (brakes || (count == BOX_OUT_BYTES && b[0] == OUT_TYPE)) && b[1] == VERSION &&
                    (get16(b + count - 4) & ~3u) == 0 && get16(b + count - 2) == 0;
  if (!valid) {
    ++box->ignored;
    return;
  }
  ++box->taken;
  box->any_out = 1;
  box->last_out_us = box->now_us;
  box->last_out_sequence = get16(b + 2);
  if (!(b[count - 4] & 1)) {
    box_release(box);
    box->arm_was_low = 1;
  } else if (box->arm_was_low && !box->stopped) {
    box->armed = 1, box->watchdog_released = 0, box->arm_was_low = 0;
  }
  for (k = 0; k < BOX_TRACKS && box->armed; ++k) {
    box->clamp[k] = get16(b + 4 + 2 * k);
    box->rotary[k] = brakes ? get16(b + 12 + 2 * k) : box->clamp[k];
  }
}

/* --- control requests -----------------------------------------------------------------------------------------------
 */

int box_control(struct box* box, uint8_t request, uint16_t value, const uint8_t* data, uint16_t count,
                uint8_t reply[BOX_RECORD_BYTES]) {
  int k;
  const int may_calibrate = value == KEY && !box->armed;
  switch (request) {
    case BOX_INFO:
      reply[0] = VERSION, reply[1] = BOX_TRACKS;
      put16(reply + 2, BOX_FIRMWARE), put16(reply + 4, box->rate_hz), put16(reply + 6, box->watchdog_ms);
      put16(reply + 8, box->separate_brakes != 0);
      return 10;
    case BOX_READ_CALIBRATION:
      memcpy(reply, box->record, BOX_RECORD_BYTES);
      return BOX_RECORD_BYTES;
    case BOX_WRITE_CALIBRATION:
      if (!may_calibrate || count != BOX_RECORD_BYTES) return -1;
      memcpy(box->written, data, BOX_RECORD_BYTES);
      box->has_written = 1;
      return 0;
    case BOX_COMMIT_CALIBRATION:
      if (!may_calibrate || !box->has_written || !record_is_valid(box->written)) return -1;
      memcpy(box->record, box->written, BOX_RECORD_BYTES);
      box->calibrated = 1;
      return 0;
    case BOX_ZERO:
      if (value > 15) return -1;
      for (k = 0; k < BOX_TRACKS; ++k)
        if (value >> k & 1) box->zero_insertion[k] = box->insertion[k], box->zero_roll[k] = box->roll[k];
      return 0;
    case BOX_WATCHDOG_TIME:
      if (value < 10 || value > 500) return -1;
      box->watchdog_ms = value;
      return 0;
    case BOX_RATE:
      if (value != 125 && value != 250 && value != 500 && value != 1000) return -1;
      box->rate_hz = value;
      return 0;
    case BOX_STATISTICS:
      put32(reply, box->sent), put32(reply + 4, box->taken);
      put32(reply + 8, box->ignored), put32(reply + 12, box->releases);
      return 16;
  }
  return -1;
}
