// A trace of the monitor: whole numbers of a unit, null where there is none.
export function drawStrip(canvas, samples, least, most, colour) {
  const ratio = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (!width) return;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext('2d');
  pen.scale(ratio, ratio);
  pen.strokeStyle = '#1d242b';
  pen.beginPath();
  for (let s = 1; s < 5; ++s) { pen.moveTo(width * s / 5, 0); pen.lineTo(width * s / 5, height); }
  pen.stroke();
  pen.strokeStyle = colour;
  pen.lineWidth = 1.6;
  pen.beginPath();
  let down = false;
  samples.forEach((value, i) => {
    if (value === null) { down = false; return; }
    const x = width * i / samples.length;
    const y = height - 3 - (height - 6) * Math.max(0, Math.min(1, (value - least) / (most - least)));
    down ? pen.lineTo(x, y) : pen.moveTo(x, y);
    down = true;
  });
  pen.stroke();
}
