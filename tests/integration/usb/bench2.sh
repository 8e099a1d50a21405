#!/usr/bin/env bash
# Bench 2: bench2.sh TEST FOLDER [arguments of the test]: runs TEST in a virtual machine with Debian's own kernel, which is unpacked
# into FOLDER, not installed. Exit code 77: it cannot be done here. OSTIUM_USB_REPORTS goes through to the test. With
# --fetch-only as the third argument: only fetches the kernel.
set -euo pipefail
test=$1 folder=$2
shift 2

skip() {
  echo "skipped: $*" >&2
  exit 77
}

for tool in qemu-system-x86_64 busybox cpio gzip dpkg-deb apt-get apt-cache ldd; do
  command -v "$tool" >/dev/null || skip "$tool is missing"
done
# shellcheck disable=SC1091
. /etc/os-release
[[ $ID == debian ]] || skip "the kernel is Debian's, and this is $ID"

# The packages, once; in a folder of their own, so that a download that was cut short is not taken for one.
fetch() { # fetch NAME PACKAGE
  [[ -d $folder/$1 ]] && return
  rm -rf "$folder/$1.part"
  mkdir -p "$folder/$1.part"
  (cd "$folder/$1.part" && apt-get -qq download "$2" >apt.log 2>&1 && dpkg-deb -x ./*.deb . && rm ./*.deb) ||
    skip "$2 cannot be fetched: $(tail -n 1 "$folder/$1.part/apt.log")"
  mv "$folder/$1.part" "$folder/$1"
}
mkdir -p "$folder"
exec 8>"$folder/lock"
flock 8
kernel_package=$(apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/.*Depends: //p' | head -n 1)
[[ -n $kernel_package ]] || [[ -d $folder/kernel ]] || skip "linux-image-amd64 is unknown: apt-get update"
fetch kernel "$kernel_package"
fetch udev udev
[[ ${1:-} != --fetch-only ]] || exit 0

# What runs in there: busybox, udev, the test and their libraries.
root=$folder/root
rm -rf "$root"
mkdir -p "$root"/{bin,dev,proc,sys,run,tmp,lib,lib64,modules,etc/udev/rules.d}
cp "$(dirname "$0")/../../../device/70-ostium-box.rules" "$root/etc/udev/rules.d/"
cp "$(command -v busybox)" "$root/bin/busybox"
cp "$test" "$root/bin/usb-bench"
cp "$folder/udev/bin/udevadm" "$root/bin/systemd-udevd"
libraries() {
  ldd "$@" | sed -n 's/.*=> \(\/[^ ]*\).*/\1/p; s/^[[:space:]]*\(\/[^ ]*ld-linux[^ ]*\).*/\1/p' | sort -u
}
ldd "$root/bin/systemd-udevd" | grep -q "not found" && skip "a library of udev is missing"
libraries "$root/bin/usb-bench" "$root/bin/systemd-udevd" | while read -r library; do
  mkdir -p "$root$(dirname "$library")"
  cp -L "$library" "$root$library"
done
for module in usb-common usbcore usbip-core vhci-hcd; do
  find "$folder/kernel/lib/modules" -name "$module.ko" -exec cp {} "$root/modules/" \;
done
cat >"$root/init" <<EOF
#!/bin/busybox sh
/bin/busybox mkdir -p /usr/bin /sbin
/bin/busybox --install -s /bin
export PATH=/bin
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs devtmpfs /dev
mount -t tmpfs tmpfs /run
mount -t tmpfs tmpfs /tmp
for module in usb-common usbcore usbip-core vhci-hcd; do insmod /modules/\$module.ko; done
systemd-udevd --daemon
export OSTIUM_USB_REPORTS=${OSTIUM_USB_REPORTS:-}
[ -n "\$OSTIUM_USB_REPORTS" ] || unset OSTIUM_USB_REPORTS
# If it hangs: where.
(
  sleep $((${OSTIUM_BENCH2_S:-150} - 30))
  for task in /proc/\$(pidof usb-bench)/task/*; do cat \$task/comm \$task/stack; done
  echo w >/proc/sysrq-trigger
  dmesg | tail -n 80
) &
usb-bench --gtest_color=no $*
echo "bench 2 ended with \$?"
poweroff -f
EOF
chmod +x "$root/init"
(cd "$root" && find . | cpio -o -H newc 2>/dev/null | gzip -1) >"$folder/initramfs.gz"

log=$folder/log
timeout "${OSTIUM_BENCH2_S:-150}" qemu-system-x86_64 -accel tcg -cpu max -smp 1 -m 512 -nodefaults -no-reboot \
  -display none -serial stdio -kernel "$folder"/kernel/boot/vmlinuz-* -initrd "$folder/initramfs.gz" \
  -append "console=ttyS0 quiet loglevel=1 panic=-1 mitigations=off" </dev/null 2>&1 | tr -d '\r' >"$log" || true
cat "$log"
result=$(sed -n 's/^bench 2 ended with \([0-9]*\).*/\1/p' "$log")
exit "${result:-1}"
