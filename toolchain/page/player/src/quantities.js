// The plotted quantities and the states of a cycle, in words.

const lengthScale = 1e3;

/** Returns the plotted quantities. `largestTorque` chooses a unit [Nm]. A value times `scale` is in `unit`. */
export function quantities(largestTorque) {
  const small = largestTorque < 0.1;
  return [
    { key: 'force', name: 'Force', unit: 'N', scale: 1, digits: 2 },
    { key: 'torque', name: 'Torque', unit: small ? 'mNm' : 'Nm', scale: small ? 1e3 : 1, digits: small ? 2 : 3 },
    {
      key: 'depth', name: 'Depth inside', unit: 'mm', scale: lengthScale, digits: 3,
      hint: 'Of the deepest sample point of the god object. Red: inside. Negative: the nearest point is so far away.',
    },
    {
      key: 'stretch', name: 'Hand to god object', unit: 'mm', scale: lengthScale, digits: 2,
      hint: 'Distance of the centres of mass: the stretch of the spring.',
    },
    { key: 'contacts', name: 'Contacts', unit: '', scale: 1, digits: 0, stepped: true },
    {
      key: 'time', name: 'Computing time', unit: 'µs', scale: 1e6, digits: 1, logarithmic: true,
      hint: 'Time of all steps of a cycle on the machine that computed it.',
    },
  ];
}

const words = {
  free: 'nothing holds the god object',
  contact: 'the surface holds the god object',
  cut: 'the motion continues in the next cycle',
  start_inside: 'began inside and is moving out',
  overflow: 'more near points than there is room for',
  infeasible: 'not all gaps can be reached at once',
  bad_input: 'the pose was invalid: held without force',
};

export function statusText(status) {
  return words[status] ?? status;
}
