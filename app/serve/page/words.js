// Words of the page and of the lessons, for who has never heard them.
const words = [
  ['ACT', 'how many seconds blood takes to clot; heparin makes it longer'],
  ['aorta', 'the great vessel from the heart downwards; its bend behind the breastbone is the arch'],
  ['atm', 'atmosphere, the pressure of the air round us; a balloon is filled with 6 to 20'],
  ['balloon', 'a small bag on a thin tube; filled with liquid it widens the artery'],
  ['C-arm', 'the frame with X-ray tube and camera, which turns round the patient'],
  ['cine', 'a film: more X-rays, a better picture, and it is kept'],
  ['contrast', 'a dye that X-rays see; injected through the guide it shows the blood'],
  ['Conus, RV, PLV, PDA', 'branches of the right coronary: the first two leave it on the way, the others are where it ends'],
  ['coronary arteries', 'they feed the heart itself: the right coronary (RCA), and the left main (LM) with its two branches LAD and LCx'],
  ['damped, ventricularised', 'the pressure curve gets flat, or falls deeply in each beat: the tip of the guide closes the artery'],
  ['dose', 'how much X-rays the patient gets'],
  ['ECG', 'the heart\'s electricity; ST is the stretch in it that shifts when the heart lacks blood'],
  ['fluoroscopy', 'live X-rays, seen as long as the pedal is down'],
  ['flow', 'how much blood gets through, as a share of what the heart\'s muscle needs'],
  ['gauge', 'shows the pressure in the balloon'],
  ['groin, sheath', 'instruments enter an artery in the groin, through a short tube, the sheath'],
  ['guide', 'guide catheter: the tube that leads to the artery; all else goes through it'],
  ['heparin', 'a drug that keeps blood from clotting on the instruments'],
  ['indeflator', 'the syringe with a gauge that fills and empties a balloon'],
  ['lesion, narrowing', 'the stretch of artery that is too narrow; stenosis is the share of the width that is missing'],
  ['N, newton', 'force: about the weight of a bar of chocolate'],
  ['nitrate', 'a drug that widens the arteries'],
  ['reference', 'a picture that is kept beside the live one'],
  ['roadmap', 'the artery of an earlier film, shown behind the live picture'],
  ['stent', 'a tube of metal mesh that is left in the artery and holds it open'],
  ['tear hazard', 'how near the wire is to piercing the artery; 0 is none'],
  ['trace', 'the red curve: the pressure at the tip of the guide'],
  ['valve', 'the door between heart and aorta; the coronary arteries leave just above it'],
  ['view', 'from where the C-arm looks: AP from the front, LAO and RAO from the patient\'s left and right front, cranial and caudal from head and feet'],
  ['wire', 'thin and soft at its end; what follows slides over it. The thick one is 0.9 mm, the thin one 0.36 mm'],
];

export function fillGlossary(table) {
  table.replaceChildren();
  for (const [word, meaning] of words) {
    const row = table.insertRow();
    row.append(Object.assign(document.createElement('th'), { scope: 'row', textContent: word }));
    row.insertCell().textContent = meaning;
  }
}
