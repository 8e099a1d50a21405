// JPEG pictures to a canvas. While one is decoded, only the newest of those that come is kept.
export class Picture {
  constructor(canvas, shown) {
    this.canvas = canvas;
    this.shown = shown;
    this.next = null;
    this.busy = false;
  }
  async take(bytes) {
    this.next = bytes;
    if (this.busy) return;
    this.busy = true;
    while (this.next) {
      const now = this.next;
      this.next = null;
      try {
        const image = await createImageBitmap(new Blob([now.subarray(16)], { type: 'image/jpeg' }));
        if (this.canvas.width !== image.width) { this.canvas.width = image.width; this.canvas.height = image.height; }
        this.canvas.getContext('2d').drawImage(image, 0, 0);
        image.close();
        this.shown?.();
      } catch { /* cut off: the next one comes */ }
    }
    this.busy = false;
  }
}
